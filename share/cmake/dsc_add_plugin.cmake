# dsc_add_plugin(NAME SOURCES ... [LINK targets...] [TESTS ...])
#
# A plugin, libdsc_NAME.so, by the same rules inside this project and outside of it:
#   NAME     lower case, the name that DSC_PLUGIN gives
#   SOURCES  its sources; one of them holds DSC_PLUGIN(...) { ... }
#   LINK     further targets; a heavy or differently licensed library belongs into a plugin of its own
#   TESTS    doctest sources, run by ctest as test_plugin_NAME: they see the strategy's own headers and, through the
#            macro DSC_TEST_PLUGIN, the path of the library
# Targets: plugin_NAME (the library), test_plugin_NAME.
function(dsc_add_plugin name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK;TESTS" ${ARGN})
  if(NOT name MATCHES "^[a-z][a-z0-9_]*$")
    message(FATAL_ERROR "dsc_add_plugin(${name}): a plugin's name has the form [a-z][a-z0-9_]*")
  endif()
  if(NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dsc_add_plugin(${name} SOURCES ... [LINK ...] [TESTS ...]): wrong '${arg_UNPARSED_ARGUMENTS}' or no sources")
  endif()

  # The sources are compiled once for the library and its tests.
  add_library(plugin_${name}_objects OBJECT ${arg_SOURCES})
  target_compile_features(plugin_${name}_objects PUBLIC cxx_std_20)
  target_compile_options(plugin_${name}_objects PRIVATE -ffp-contract=off)
  target_include_directories(plugin_${name}_objects PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(plugin_${name}_objects PUBLIC dsc::core ${arg_LINK} PRIVATE $<TARGET_NAME_IF_EXISTS:dsc_flags>)
  set_target_properties(plugin_${name}_objects PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)

  add_library(plugin_${name} MODULE $<TARGET_OBJECTS:plugin_${name}_objects>)
  target_link_libraries(plugin_${name} PRIVATE dsc::core ${arg_LINK} $<TARGET_NAME_IF_EXISTS:dsc_flags>)
  # Missing symbols shall fail the build, not the experiment. clang links the sanitizers' runtime only into programs.
  if(NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND (DSC_SANITIZE OR CMAKE_CXX_FLAGS MATCHES "-fsanitize")))
    target_link_options(plugin_${name} PRIVATE -Wl,-z,defs)
  endif()
  set_target_properties(plugin_${name} PROPERTIES LINKER_LANGUAGE CXX PREFIX "lib" OUTPUT_NAME "dsc_${name}" SUFFIX ".so"
    INSTALL_RPATH "$ORIGIN/../..")
  if(DSC_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(plugin_${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${DSC_PLUGIN_OUTPUT_DIRECTORY}")
  endif()
  set_property(GLOBAL APPEND PROPERTY DSC_PLUGINS plugin_${name})

  if(arg_TESTS AND DSC_BUILD_TESTS)
    add_executable(test_plugin_${name} ${arg_TESTS} $<TARGET_OBJECTS:plugin_${name}_objects>)
    target_include_directories(test_plugin_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(test_plugin_${name} PRIVATE dsc::core dsc::host dsc::sdk doctest::doctest ${arg_LINK}
      $<TARGET_NAME_IF_EXISTS:dsc_flags>)
    target_compile_definitions(test_plugin_${name} PRIVATE DSC_TEST_PLUGIN="$<TARGET_FILE:plugin_${name}>")
    add_dependencies(test_plugin_${name} plugin_${name})
    include(doctest)
    doctest_discover_tests(test_plugin_${name} TEST_PREFIX "plugin.${name}." PROPERTIES LABELS "plugin" TIMEOUT 300)
  endif()
endfunction()
