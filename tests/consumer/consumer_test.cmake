# Installs the built project to a prefix of its own, builds strangers' programs against it, by
# find_package and by pkg-config, and runs them.
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DCOMPILER=... -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGV}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(file bin/fairway bin/fairway-check share/man/man1/fairway.1.gz share/man/man1/fairway-check.1.gz
    share/man/man1/fairway-run.1.gz share/bash-completion/completions/fairway
    share/zsh/vendor-completions/_fairway share/fish/vendor_completions.d/fairway.fish
    share/doc/fairway/LICENSE share/doc/fairway/docs/tutorial.md share/doc/fairway/examples/demo/demo.toml)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()

# by_cmake(PROGRAM OPTION...): builds SOURCE/PROGRAM with CMake.
function(by_cmake program)
  run(${CMAKE_COMMAND} -S ${SOURCE}/${program} -B ${WORK}/${program} -G Ninja
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release ${ARGN})
  run(${CMAKE_COMMAND} --build ${WORK}/${program})
endfunction()
# by_pkg_config(PROGRAM MODULE PREFIX QUESTION...): builds it as PROGRAM_by_hand, without CMake.
function(by_pkg_config program module prefix)
  file(GLOB modules ${prefix}/lib*/pkgconfig/${module}.pc ${prefix}/lib*/*/pkgconfig/${module}.pc)
  get_filename_component(folder "${modules}" DIRECTORY)
  run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} pkg-config ${ARGN} ${module})
  string(STRIP "${output}" flags)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${COMPILER} -std=c++20 -O2 ${SOURCE}/${program}/main.cpp ${flags} -o ${WORK}/${program}_by_hand)
endfunction()

by_cmake(library)
run(${WORK}/library/consumer ${WORK}/plan.safetensors)
set(by_find_package "${output}")
by_pkg_config(library fairway ${WORK}/prefix --cflags --libs)
run(${WORK}/library_by_hand ${WORK}/plan.safetensors)
if(NOT output STREQUAL by_find_package)
  message(FATAL_ERROR "pkg-config built another program than find_package")
endif()

# On board: no other package is there. The prefix has moved, and pkg-config finds it where it is.
run(${WORK}/prefix/bin/fairway --version)
run(${WORK}/prefix/bin/fairway verify ${WORK}/plan.safetensors --undecided-max 0.05 --quiet
  -o ${WORK}/certificate.safetensors)
foreach(package TBB fmt nlohmann_json OpenSSL)
  list(APPEND nothing_else -DCMAKE_DISABLE_FIND_PACKAGE_${package}=TRUE)
endforeach()
by_cmake(on_board ${nothing_else})
run(${WORK}/on_board/on_board ${WORK}/certificate.safetensors)
set(by_find_package "${output}")
file(RENAME ${WORK}/prefix ${WORK}/moved)
by_pkg_config(on_board fairway-runtime ${WORK}/moved --cflags)
run(${WORK}/on_board_by_hand ${WORK}/certificate.safetensors)
if(NOT output STREQUAL by_find_package)
  message(FATAL_ERROR "pkg-config built another program than find_package")
endif()

# The whole package cannot be had without its dependencies, and says so.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/library -B ${WORK}/without -G Ninja
  -DCMAKE_PREFIX_PATH=${WORK}/moved -DCMAKE_CXX_COMPILER=${COMPILER} ${nothing_else}
  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "TBB")
  message(FATAL_ERROR "find_package(fairway) without TBB: ${output}")
endif()
