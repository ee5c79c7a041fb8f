# npm ci into the bundle's folder. Offline it leaves an empty stamp, and bundle.cmake says so.
file(MAKE_DIRECTORY ${BUNDLE})
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json DESTINATION ${BUNDLE})
execute_process(
  COMMAND ${NPM} ci --omit=dev --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error
    --fetch-retries=1 --fetch-timeout=60000
  WORKING_DIRECTORY ${BUNDLE} TIMEOUT 300 RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT status EQUAL 0)
  if(MUST STREQUAL "ON")
    message(FATAL_ERROR "npm ci failed:\n${said}")
  endif()
  string(SUBSTRING "${said}" 0 600 said)
  message(WARNING "The interactive page is left out: npm ci failed.\n${said}")
  file(WRITE ${STAMP} "")
endif()
