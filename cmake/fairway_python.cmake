# Whether the Python package can be built, decided before the libraries, because it needs them
# position-independent. It is for the system's Python, regardless of the path.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python to build for")
endif()
find_package(Python3 COMPONENTS Interpreter Development.Module QUIET)
if(Python3_Interpreter_FOUND AND Python3_Development.Module_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(pybind11_FOUND AND NOT FAIRWAY_SANITIZE)  # a sanitized module needs a sanitized Python
  set(fairway_python_default ON)
else()
  set(fairway_python_default OFF)
endif()
option(FAIRWAY_BUILD_PYTHON "Build the Python package (needs pybind11)" ${fairway_python_default})
if(FAIRWAY_BUILD_PYTHON AND NOT pybind11_FOUND)
  message(FATAL_ERROR "FAIRWAY_BUILD_PYTHON needs pybind11 and the headers of ${Python3_EXECUTABLE}: "
    "packages pybind11-dev and python3-dev")
endif()
set(FAIRWAY_PYTHON_DIR lib/python3/dist-packages CACHE STRING
  "Where the package goes, below the prefix: below /usr, Debian's own folder")
