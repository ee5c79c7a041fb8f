# One HTML file of all sources; or a sentence, when the packages could not be had.
file(COPY ${SOURCE}/src ${SOURCE}/build.mjs DESTINATION ${BUNDLE})
file(READ ${BUNDLE}/node_modules/.package-lock.json installed LIMIT 1)
if(installed STREQUAL "")
  file(WRITE ${PAGE} "npm could not fetch its packages when fairway was built (delete "
    "${BUNDLE}/node_modules and build again)")
  return()
endif()
execute_process(COMMAND ${NODE} build.mjs ${PAGE} WORKING_DIRECTORY ${BUNDLE} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "bundling the page failed")
endif()
