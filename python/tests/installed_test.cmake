# Installs the built project to a prefix of its own and runs the tutorial with what is there.
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DPYTHON=... -DSITE=lib/python3.N/dist-packages
#   -DPACKAGES=lib/python3/dist-packages -P installed_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT status EQUAL 0 AND NOT status EQUAL 77)  # 77: no pytest, as it says
    message(FATAL_ERROR "failed (${status}): ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK})
# As Debian's Python finds what is below /usr/local.
run(${PYTHON} -c "import site; site.addsitedir('${WORK}/${SITE}'); import fairway; print(fairway.__file__); assert fairway.__file__.startswith('${WORK}/')")
run(${CMAKE_COMMAND} -E env PYTHONPATH=${WORK}/${PACKAGES} PYTHONDONTWRITEBYTECODE=1
  FAIRWAY=${WORK}/bin/fairway FAIRWAY_SOURCE=${SOURCE}
  ${PYTHON} ${SOURCE}/python/tests/run_tests.py ${SOURCE}/python/tests/test_docs.py)
