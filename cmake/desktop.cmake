# What a desktop and a shell know of the program: man pages and completions, made by the program itself, the entry in the
# menu, its description for software centres, its icon and the types of its files.
if(ESPALIER_SANITIZE OR ESPALIER_FUZZ OR CMAKE_CROSSCOMPILING OR NOT UNIX)
  return()
endif()
set(made ${PROJECT_BINARY_DIR}/made)
add_custom_command(OUTPUT ${made}/done
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${made}
  COMMAND espalier_program man ${made}/man
  COMMAND espalier_program completion bash > ${made}/espalier
  COMMAND espalier_program completion zsh > ${made}/_espalier
  COMMAND espalier_program completion fish > ${made}/espalier.fish
  COMMAND ${CMAKE_COMMAND} -E touch ${made}/done
  DEPENDS espalier_program $<TARGET_NAME_IF_EXISTS:espalier_look_commands>
  COMMENT "Man pages and completions" VERBATIM)
add_custom_target(espalier_made ALL DEPENDS ${made}/done)

set(share ${CMAKE_INSTALL_DATADIR})
set(zsh_functions ${share}/zsh/site-functions)
set(fish_completions ${share}/fish/vendor_completions.d)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr AND EXISTS /etc/debian_version)
  set(zsh_functions ${share}/zsh/vendor-completions)
endif()
# A build of single targets has not made them.
install(DIRECTORY ${made}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
install(FILES ${made}/espalier DESTINATION ${share}/bash-completion/completions COMPONENT program OPTIONAL)
install(FILES ${made}/_espalier DESTINATION ${zsh_functions} COMPONENT program OPTIONAL)
install(FILES ${made}/espalier.fish DESTINATION ${fish_completions} COMPONENT program OPTIONAL)
if(APPLE)
  return()
endif()

string(TIMESTAMP ESPALIER_DATE "%Y-%m-%d" UTC)
configure_file(packaging/share/espalier.metainfo.xml espalier.metainfo.xml @ONLY)
install(FILES packaging/share/espalier.desktop DESTINATION ${share}/applications COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/espalier.metainfo.xml DESTINATION ${share}/metainfo COMPONENT program)
install(FILES packaging/share/espalier.xml DESTINATION ${share}/mime/packages COMPONENT program)
install(FILES studio/dist/icon.svg DESTINATION ${share}/icons/hicolor/scalable/apps RENAME espalier.svg COMPONENT program)
