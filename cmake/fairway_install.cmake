# Install and export. find_package(fairway) gives two targets, pkg-config two modules:
#   fairway::fairway, fairway          the core library with the headers of its nouns and verbs
#   fairway::runtime, fairway-runtime  only headers, for the vehicle: fairway/runtime.hpp and what
#                                      it includes; find_package(fairway COMPONENTS runtime) needs
#                                      no other package
include(CMakePackageConfigHelpers)

install(TARGETS fairway_runtime EXPORT fairway_runtime_targets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS fairway EXPORT fairway_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS fairway_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

set(fairway_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/fairway)
foreach(set fairway_targets fairway_runtime_targets)
  install(EXPORT ${set} NAMESPACE fairway:: DESTINATION ${fairway_package_dir} COMPONENT development)
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/fairway-config.cmake.in
  ${PROJECT_BINARY_DIR}/fairway-config.cmake INSTALL_DESTINATION ${fairway_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fairway-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fairway-config.cmake
  ${PROJECT_BINARY_DIR}/fairway-config-version.cmake DESTINATION ${fairway_package_dir}
  COMPONENT development)

# For pkg-config. The prefix is derived from the file's location, so any PREFIX works.
set(fairway_pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH fairway_up /prefix/${fairway_pkgconfig_dir} /prefix)  # ../..
string(REGEX REPLACE "/$" "" fairway_up ${fairway_up})
set(fairway_requires "tbb")
set(fairway_requires_private "fmt libcrypto")
if(NOT BUILD_SHARED_LIBS)  # a static library passes its own dependencies on to the linker
  string(APPEND fairway_requires " ${fairway_requires_private}")
  set(fairway_requires_private "")
endif()
foreach(module fairway fairway-runtime)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${module}.pc.in ${PROJECT_BINARY_DIR}/${module}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${module}.pc DESTINATION ${fairway_pkgconfig_dir}
    COMPONENT development)
endforeach()

# The docs, as they are here, and the demonstration. Debian keeps licences elsewhere.
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
install(DIRECTORY demo/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/demo
  PATTERN "*.py" EXCLUDE)
