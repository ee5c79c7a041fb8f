# Install and export: find_package(fairway) gives fairway::fairway.
