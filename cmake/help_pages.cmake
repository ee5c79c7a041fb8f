# Manual pages and shell completions, made from the --help output of the built programs.
if(NOT Python3_EXECUTABLE)
  message(STATUS "Manual pages and completions are left out: no Python 3")
  return()
endif()
set(pages ${PROJECT_BINARY_DIR}/help)
set(scripts ${PROJECT_SOURCE_DIR}/tools)
set(programs $<TARGET_FILE:fairway_command> $<TARGET_FILE:fairway_check>)
set(python ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 ${Python3_EXECUTABLE} -B)
string(TIMESTAMP today "%Y-%m-%d" UTC)  # or SOURCE_DATE_EPOCH
add_custom_command(OUTPUT ${pages}/made
  COMMAND ${python} ${scripts}/manual_pages.py --version ${PROJECT_VERSION} --date ${today}
    -o ${pages}/man1 ${programs}
  COMMAND ${python} ${scripts}/completions.py -o ${pages}/completions ${programs}
  COMMAND ${CMAKE_COMMAND} -E touch ${pages}/made
  DEPENDS fairway_command fairway_check
    ${scripts}/help_texts.py ${scripts}/manual_pages.py ${scripts}/completions.py
  COMMENT "Manual pages and completions" VERBATIM)
add_custom_target(fairway_help_pages ALL DEPENDS ${pages}/made)

install(DIRECTORY ${pages}/man1/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(DIRECTORY ${pages}/completions/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(DIRECTORY ${pages}/completions/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(DIRECTORY ${pages}/completions/fish/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

if(FAIRWAY_BUILD_TESTS)
  add_test(NAME help_pages
    COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/tests/help_pages_test.py ${pages} ${programs})
endif()
