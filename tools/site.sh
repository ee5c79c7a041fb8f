#!/bin/sh
# The documentation as a site: the pages of docs/, the API pages made from the sources, and the
# changelog, assembled for mkdocs (mkdocs.yml). Its search needs a server:
# python3 -m http.server -d build/site
# Usage: tools/site.sh PYTHON_PACKAGE [BUILD_FOLDER]: makes BUILD_FOLDER/site. Exit code 77: no mkdocs.
set -eu
package=$(realpath "$1")
build=$(realpath "${2:-build}")
cd "$(dirname "$0")/.."
pages=$build/site-pages
themes=/usr/share/mkdocs/themes  # where Debian installs this one; Python does not look there by default
PYTHONPATH=$themes /usr/bin/python3 -c 'import mkdocs, material' 2>/dev/null || {
  echo "site: please install mkdocs and mkdocs-material" >&2
  exit 77
}

rm -rf "$pages"
mkdir -p "$pages/api"
cp -r docs/. "$pages"
cp CHANGELOG.md "$pages/changelog.md"
# Links to source files are dropped where there are no sources.
sed -i 's/\[\([^]]*\)\](\.\.\/[^)]*)/\1/g' "$pages"/*.md
sed -i 's/\[\([^]]*\)\](\.\.\/\.\.\/[^)]*)/\1/g' "$pages"/howto/*.md
/usr/bin/python3 -B tools/api_reference.py cpp . >"$pages/api/cpp.md"
/usr/bin/python3 -B tools/api_reference.py python "$package" >"$pages/api/python.md"
printf 'INHERIT: %s\ndocs_dir: %s\nsite_dir: %s\n' "$PWD/mkdocs.yml" "$pages" "$build/site" \
  >"$build/mkdocs.yml"
PYTHONPATH=$themes /usr/bin/python3 -B -m mkdocs build --quiet -f "$build/mkdocs.yml"
echo "The documentation is at $build/site/index.html."
