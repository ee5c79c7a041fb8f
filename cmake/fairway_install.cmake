# Install and export: find_package(fairway) gives fairway::fairway, the core library with the
# headers of its nouns and verbs, and the command.
include(CMakePackageConfigHelpers)

install(TARGETS fairway EXPORT fairway_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS fairway_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

set(fairway_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/fairway)
install(EXPORT fairway_targets NAMESPACE fairway:: DESTINATION ${fairway_package_dir}
  COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/fairway-config.cmake.in
  ${PROJECT_BINARY_DIR}/fairway-config.cmake INSTALL_DESTINATION ${fairway_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fairway-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fairway-config.cmake
  ${PROJECT_BINARY_DIR}/fairway-config-version.cmake DESTINATION ${fairway_package_dir}
  COMPONENT development)

# The docs, as they stand here, and the demonstration. Debian keeps licences elsewhere.
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
install(DIRECTORY demo/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/demo
  PATTERN "*.py" EXCLUDE)
