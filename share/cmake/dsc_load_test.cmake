# cmake -DPROGRAM=dsc -DLIBRARY=libdsc_NAME.so -P dsc_load_test.cmake
#
# Fails with dsc's own words where the plugin is refused. What else is on the search path is none of this build's business.
set(check plugin doctor)
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env --unset=DSC_PLUGIN_PATH XDG_DATA_HOME=/nonexistent ${PROGRAM} ${check} ${LIBRARY}
  OUTPUT_VARIABLE said ERROR_VARIABLE complaint RESULT_VARIABLE code)
if(NOT code STREQUAL 0)
  message(NOTICE "${complaint}${said}")
  message(FATAL_ERROR "the plugin was built, but dsc does not take it (${code}): see above")
endif()
