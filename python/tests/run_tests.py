#!/usr/bin/env python3
"""Runs the package's tests, or says why it cannot (exit code 77: skipped).

Usage: run_tests.py FOLDER [pytest arguments]
"""
import sys

try:
    import pytest
except ImportError:
    print(f"skipped: {sys.executable} has no pytest (package python3-pytest)")
    sys.exit(77)

sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", "--import-mode=importlib", *sys.argv[1:]]))
