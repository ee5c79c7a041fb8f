# What all targets of the project share, and how the tests of a folder are declared.

function(fairway_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF VERIFY_INTERFACE_HEADER_SETS ON)
  # The same bits on every machine: no contraction, no fast-math, no -march=native.
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion
    -Wno-sign-conversion -Wnon-virtual-dtor)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 warns of overlaps in "literal" + std::string that do not exist (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  get_target_property(type ${target} TYPE)
  if(FAIRWAY_BUILD_PYTHON AND type STREQUAL "STATIC_LIBRARY")
    # For the Python module; calls within the library still stay direct and are inlined.
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  endif()
  if(FAIRWAY_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(FAIRWAY_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${FAIRWAY_SANITIZE}
      -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${FAIRWAY_SANITIZE})
  endif()
endfunction()

# fairway_sources(TARGET SOURCES a.cpp ... HEADERS a.hpp ...): paths relative to the folder.
# Headers keep their path below the project: "fairway/map/region.hpp" here and when installed.
function(fairway_sources target)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS" ${ARGN})
  list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(TRANSFORM ARG_HEADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  target_sources(${target}
    PRIVATE ${ARG_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
endfunction()

# fairway_compiled_alone(TARGET a.cpp ...): sources, relative to the folder, that a unity build
# (CMAKE_UNITY_BUILD, as in .ci/run) leaves out, for they name things as other files do.
function(fairway_compiled_alone target)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# fairway_headers_behind(RESULT HEADER): HEADER and every header of the project that it includes,
# directly or not, as absolute paths. Reconfigures when one of them changes.
function(fairway_headers_behind result header)
  set(found "")
  set(waiting ${header})
  while(waiting)
    list(POP_FRONT waiting name)
    set(path ${PROJECT_SOURCE_DIR}/${name})
    if(NOT path IN_LIST found)
      list(APPEND found ${path})
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
      file(STRINGS ${path} includes REGEX "^#include \"fairway/")
      list(TRANSFORM includes REPLACE "^#include \"([^\"]+)\".*" "\\1")
      list(APPEND waiting ${includes})
    endif()
  endwhile()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# fairway_tests(NAME SOURCES a_test.cpp ... LINK fairway ...): one GoogleTest program, one CTest.
function(fairway_tests name)
  if(NOT FAIRWAY_BUILD_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  add_executable(${name} ${ARG_SOURCES})
  fairway_defaults(${name})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)  # tests often name their samples alike
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gtest_main GTest::gmock rapidcheck)
  target_compile_definitions(${name} PRIVATE
    FAIRWAY_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    FAIRWAY_SHARED_MAPS="${PROJECT_SOURCE_DIR}/../shared/maps")
  add_test(NAME ${name} COMMAND ${name})
  # The same draws on every run; set RC_PARAMS for another seed.
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "RC_PARAMS=seed=2013")
endfunction()
