# dsc_add_plugin(NAME SOURCES ... [LINK targets...] [TESTS ... [TEST_PLUGINS names...]] [CHECK file])
#
# A plugin, libdsc_NAME.so, by the same rules inside this project and outside of it:
#   NAME     lower case, the name that DSC_PLUGIN gives
#   SOURCES  its sources; one of them holds DSC_PLUGIN(...) { ... }
#   LINK     further targets; a heavy or differently licensed library belongs into a plugin of its own
#   TESTS    doctest sources, run by ctest as plugin.NAME.*: they see the headers of its helper files and, through the
#            macro DSC_TEST_PLUGIN, the path of the library
#   TEST_PLUGINS  other plugins of the same build that the tests load: they are built before the tests run
#   CHECK    notes for `dsc plugin check`: parameters that it cannot guess, tests that need not hold and why. @VARIABLES@ of
#            CMake are filled in; the result lies beside the library, as libdsc_NAME.check.yaml
# Targets: plugin_NAME (the library), test_plugin_NAME.
#
# Outside of this project also: the headers of dsc are compiled once into a precompiled header, which makes each later build
# faster (CMAKE_DISABLE_PRECOMPILE_HEADERS=ON turns it off); the build ends with loading the library into dsc, and fails where that does; ctest has
# NAME.conformance, which is `dsc plugin check`; and `cmake --install` copies the library to DSC_PLUGIN_INSTALL_DIR, which is
# the user's folder of plugins, or lib/dsc/plugins of CMAKE_INSTALL_PREFIX where one is given when configuring.

# What every strategy includes is parsed once and not with each change of a source: most of the time of a compilation goes into
# these headers, and most of that into Eigen. The warnings are off for the reason that dsc_add_plugin() gives below.
function(_dsc_precompile_headers name)
  set(headers <dsc/plugin/plugin.hpp>)
  foreach(hook IN ITEMS cloud_filter curvature_estimator improvement initial_mesh observer refinement_policy velocity_field)
    list(APPEND headers <dsc/hooks/${hook}.hpp>)
  endforeach()
  target_precompile_headers(plugin_${name}_objects PRIVATE ${headers})
  target_compile_options(plugin_${name}_objects PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow>)
endfunction()

# The library is loaded into the installed program as part of the build.
function(_dsc_add_load_test name)
  add_custom_command(TARGET plugin_${name} POST_BUILD VERBATIM COMMENT "Loading libdsc_${name}.so into dsc"
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:dsc::dsc> -DLIBRARY=$<TARGET_FILE:plugin_${name}>
      -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/dsc_load_test.cmake)
endfunction()

function(_dsc_add_notes name notes)
  configure_file(${notes} ${CMAKE_CURRENT_BINARY_DIR}/plugin_${name}.check.yaml @ONLY)
  file(GENERATE OUTPUT $<TARGET_FILE_DIR:plugin_${name}>/libdsc_${name}.check.yaml
    INPUT ${CMAKE_CURRENT_BINARY_DIR}/plugin_${name}.check.yaml)
endfunction()

function(_dsc_add_conformance_test name)
  add_test(NAME ${name}.conformance COMMAND dsc::dsc plugin check $<TARGET_FILE:plugin_${name}> --level standard)
  set_tests_properties(${name}.conformance PROPERTIES LABELS conformance TIMEOUT 1800)
endfunction()

function(_dsc_install_plugin name)
  if(NOT CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
    include(GNUInstallDirs)
    set(folder "${CMAKE_INSTALL_LIBDIR}/dsc/plugins")
  elseif(IS_ABSOLUTE "$ENV{XDG_DATA_HOME}")
    set(folder "$ENV{XDG_DATA_HOME}/dsc/plugins")
  else()
    set(folder "$ENV{HOME}/.local/share/dsc/plugins")
  endif()
  set(DSC_PLUGIN_INSTALL_DIR "${folder}" CACHE PATH "Where plugins go; relative: below CMAKE_INSTALL_PREFIX")
  install(TARGETS plugin_${name} LIBRARY DESTINATION "${DSC_PLUGIN_INSTALL_DIR}")
endfunction()

function(_dsc_add_plugin_test name sources link others)
  add_executable(test_plugin_${name} ${sources} $<TARGET_OBJECTS:plugin_${name}_objects> $<TARGET_OBJECTS:dsc_test_main>)
  target_include_directories(test_plugin_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(test_plugin_${name} PRIVATE dsc::sdk dsc::host doctest::doctest ${link} $<TARGET_NAME_IF_EXISTS:dsc_flags>)
  if(COMMAND dsc_quick_test)
    dsc_quick_test(test_plugin_${name})
  endif()
  target_compile_definitions(test_plugin_${name} PRIVATE DSC_TEST_PLUGIN="$<TARGET_FILE:plugin_${name}>")
  list(TRANSFORM others PREPEND plugin_)
  add_dependencies(test_plugin_${name} plugin_${name} ${others})
  include("${doctest_DIR}/doctest.cmake")
  doctest_discover_tests(test_plugin_${name} TEST_PREFIX "plugin.${name}." PROPERTIES LABELS "plugin" TIMEOUT 300)
endfunction()

# doctest and its main(), for tests outside of this project; a macro, so that the package's targets are seen by the caller.
macro(_dsc_find_doctest)
  find_package(doctest QUIET)
  if(NOT doctest_FOUND)
    message(FATAL_ERROR "dsc_add_plugin: TESTS need doctest; install it (Debian: doctest-dev) or configure with -DBUILD_TESTING=OFF")
  endif()
  if(NOT TARGET dsc_test_main)
    add_library(dsc_test_main OBJECT ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/test_main.cpp)
    target_link_libraries(dsc_test_main PRIVATE doctest::doctest dsc::core)
  endif()
endmacro()

function(dsc_add_plugin name)
  cmake_parse_arguments(arg "" "CHECK" "SOURCES;LINK;TESTS;TEST_PLUGINS" ${ARGN})
  if(NOT name MATCHES "^[a-z][a-z0-9_]*$")
    message(FATAL_ERROR "dsc_add_plugin(${name}): a plugin's name has the form [a-z][a-z0-9_]*")
  endif()
  if(NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dsc_add_plugin(${name} SOURCES ... [LINK ...] [TESTS ... [TEST_PLUGINS ...]] [CHECK ...]): wrong "
      "'${arg_UNPARSED_ARGUMENTS}' or no sources")
  endif()
  get_target_property(outside dsc::core IMPORTED)

  # The sources are compiled once for the library and its tests.
  add_library(plugin_${name}_objects OBJECT ${arg_SOURCES})
  target_compile_features(plugin_${name}_objects PUBLIC cxx_std_20)
  target_compile_options(plugin_${name}_objects PRIVATE -ffp-contract=off)
  target_include_directories(plugin_${name}_objects PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(plugin_${name}_objects PUBLIC dsc::core ${arg_LINK} PRIVATE $<TARGET_NAME_IF_EXISTS:dsc_flags>)
  set_target_properties(plugin_${name}_objects PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  # This project's own jumbo build for tests parses the headers of plugins once for all of them. With precompiled headers g++ 12
  # sees an overflow inside std::string's operator+ that is not there, as -Wno-restrict in dsc_build.cmake says.
  if(TARGET dsc_plugin_headers)
    target_compile_options(plugin_${name}_objects PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow>)
    target_precompile_headers(plugin_${name}_objects REUSE_FROM dsc_plugin_headers)
  endif()

  add_library(plugin_${name} MODULE $<TARGET_OBJECTS:plugin_${name}_objects>)
  target_link_libraries(plugin_${name} PRIVATE dsc::core ${arg_LINK} $<TARGET_NAME_IF_EXISTS:dsc_flags>)
  # Missing symbols shall fail the build, not the experiment. clang links the sanitizers' runtime only into programs.
  get_target_property(core_options dsc::core INTERFACE_COMPILE_OPTIONS)
  if(NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND "${core_options} ${CMAKE_CXX_FLAGS}" MATCHES "-fsanitize"))
    target_link_options(plugin_${name} PRIVATE -Wl,-z,defs)
  endif()
  set_target_properties(plugin_${name} PROPERTIES LINKER_LANGUAGE CXX PREFIX "lib" OUTPUT_NAME "dsc_${name}" SUFFIX ".so")
  if(DSC_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(plugin_${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${DSC_PLUGIN_OUTPUT_DIRECTORY}")
  endif()

  if(arg_CHECK)
    _dsc_add_notes(${name} ${arg_CHECK})
  endif()
  if(outside)
    _dsc_precompile_headers(${name})
    _dsc_add_load_test(${name})
    _dsc_install_plugin(${name})
    if(NOT DEFINED BUILD_TESTING OR BUILD_TESTING)
      enable_testing()
      _dsc_add_conformance_test(${name})
      if(arg_TESTS)
        _dsc_find_doctest()
        _dsc_add_plugin_test(${name} "${arg_TESTS}" "${arg_LINK}" "${arg_TEST_PLUGINS}")
      endif()
    endif()
  else()
    set_property(GLOBAL APPEND PROPERTY DSC_PLUGINS plugin_${name})
    if(arg_TESTS AND DSC_BUILD_TESTS)
      _dsc_add_plugin_test(${name} "${arg_TESTS}" "${arg_LINK}" "${arg_TEST_PLUGINS}")
    endif()
  endif()
endfunction()
