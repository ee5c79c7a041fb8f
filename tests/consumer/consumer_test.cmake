# Installs the built project to a prefix of its own, builds a stranger's program against it, runs it.
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DCOMPILER=... -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGV}")
  endif()
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
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer ${WORK}/plan.safetensors)
run(${WORK}/prefix/bin/fairway --version)
