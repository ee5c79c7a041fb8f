# Debian packages with CPack: `make package`, or the target `package` of the preset `package`. Three,
# as Debian splits such projects: users of the command need neither the headers of a static library,
# whose own dependencies are development packages, nor a module tied to one Python version.
#   fairway          the programs, their manual pages and completions, the docs, the demonstration
#   libfairway-dev   headers, the library, find_package(fairway), pkg-config
#   python3-fairway  import fairway
set(FAIRWAY_MAINTAINER "Fairway maintainers <maintainers@fairway.invalid>" CACHE STRING
  "Name and address in the packages; packagers set their own")

# What every Debian package has in its folder of /usr/share/doc, and other installs do not.
set(scratch ${PROJECT_BINARY_DIR}/packaging)
set(date_format "%a, %d %b %Y %H:%M:%S +0000")
string(TIMESTAMP fairway_date "${date_format}" UTC)  # or SOURCE_DATE_EPOCH
configure_file(${PROJECT_SOURCE_DIR}/packaging/changelog.in ${scratch}/changelog @ONLY)
find_program(FAIRWAY_GZIP gzip)
if(FAIRWAY_GZIP)
  execute_process(COMMAND ${FAIRWAY_GZIP} -9nf ${scratch}/changelog)
endif()
foreach(pair program:fairway development:libfairway-dev python:python3-fairway)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 name)
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/copyright ${scratch}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fairway)
set(CPACK_PACKAGE_VENDOR "Fairway")
set(CPACK_PACKAGE_CONTACT "${FAIRWAY_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_SET_DESTDIR ON)  # the package uses the configured prefix
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
if(FAIRWAY_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# The summary is the project's; lines as long as Debian shows, an empty one between paragraphs.
set(story "Feedback motion plans for vehicles that cannot stop and cannot turn on the\nspot: from an occupancy map, a speed, a turning radius and a goal, the\nheading to steer at every place, exact flights under that plan, and a proof\nof what it does from every place and heading.\n\n")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME fairway)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# Cairo asks for a font by name; no library dependency says so.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libfairway-dev, python3-fairway")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "${story}This package contains the commands, their manual and the demonstration.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfairway-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libtbb-dev, libfmt-dev, nlohmann-json3-dev, libssl-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "${story}This package contains the static C++ library with its headers.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-fairway)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
math(EXPR next_minor "0${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}~), python3 (<< ${Python3_VERSION_MAJOR}.${next_minor}), python3-numpy, fonts-dejavu-core")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS fairway)  # whose fairway-check re-proves certificates
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/packaging/postinst;${PROJECT_SOURCE_DIR}/packaging/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
  "${story}This package contains the Python module, which works on numpy arrays.")
include(CPack)
