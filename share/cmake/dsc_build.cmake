# How every target of the project is compiled, and the few functions that declare one.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(DSC_PLUGIN_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib/dsc/plugins")
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(DSC_CCACHE ccache)
if(DSC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${DSC_CCACHE}")
endif()

# Flags for our own code only; third-party headers come in as SYSTEM. g++ 12 reports overlapping copies inside
# std::string's operator+ that are not there (GCC bug 105651), hence -Wno-restrict.
add_library(dsc_flags INTERFACE)
target_compile_options(dsc_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  -ffp-contract=off $<$<BOOL:${DSC_WERROR}>:-Werror>)
# g++ 12 loses track of what is initialised in code that the sanitizers instrument.
if(DSC_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(dsc_flags INTERFACE -Wno-maybe-uninitialized)
endif()
# A unity build compiles the sources of a target as one. Whether a name hides another one, and whether a type that others see has
# parts that they cannot see, is checked file by file, which only the other presets do.
if(CMAKE_UNITY_BUILD)
  target_compile_options(dsc_flags INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(DSC_SANITIZE STREQUAL "address")
  target_compile_options(dsc_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(dsc_flags INTERFACE -fsanitize=address,undefined)
elseif(DSC_SANITIZE STREQUAL "thread")
  target_compile_options(dsc_flags INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(dsc_flags INTERFACE -fsanitize=thread)
elseif(NOT DSC_SANITIZE STREQUAL "")
  message(FATAL_ERROR "DSC_SANITIZE=${DSC_SANITIZE}: accepted are address and thread")
endif()
# libFuzzer counts what an input reaches, so all of the core is instrumented.
if(DSC_FUZZ)
  target_compile_options(dsc_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# dsc_cold_code(TARGET): nothing in it takes part in a step. A jumbo build, which everybody waits for, compiles it with few
# optimisations. With -O1, g++ 12 warns of an empty std::optional that is moved.
function(dsc_cold_code target)
  if(CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE -O1 $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  endif()
endfunction()

# dsc_quick_test(TARGET): its sources are tests. A jumbo build compiles them to be run once: with few optimisations, which
# halves the time in the compiler, and with the headers that most of them include parsed once for all. Like every jumbo
# source, they are compiled file by file and as users compile in the other presets.
function(dsc_quick_test target)
  if(CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE -O1)
    target_precompile_headers(${target} REUSE_FROM dsc_test_headers)
  endif()
endfunction()

# dsc_module(NAME SOURCES ... [USES modules...] [LINK third-party targets...])
# One module of the core. Its objects go into the shared core; the static library dsc_NAME is for tests, which link only
# the modules named by USES: a call in the wrong direction does not link.
function(dsc_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES;LINK" ${ARGN})
  list(TRANSFORM arg_USES PREPEND dsc_ OUTPUT_VARIABLE used)
  add_library(dsc_${name}_objects OBJECT ${arg_SOURCES})
  target_include_directories(dsc_${name}_objects PRIVATE ${PROJECT_SOURCE_DIR}/core/include
    ${PROJECT_BINARY_DIR}/core/include ${PROJECT_SOURCE_DIR}/core/src)
  target_link_libraries(dsc_${name}_objects PRIVATE Eigen3::Eigen dsc_flags ${arg_LINK})
  add_library(dsc_${name} STATIC $<TARGET_OBJECTS:dsc_${name}_objects>)
  set_target_properties(dsc_${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(dsc_${name} INTERFACE ${PROJECT_SOURCE_DIR}/core/include ${PROJECT_BINARY_DIR}/core/include)
  target_link_libraries(dsc_${name} PUBLIC ${used} Eigen3::Eigen PRIVATE ${arg_LINK})
  set_property(GLOBAL APPEND PROPERTY DSC_MODULES ${name})
  set_property(GLOBAL APPEND PROPERTY DSC_CORE_LINK ${arg_LINK})
endfunction()

# dsc_backend(MODULE NAME TYPE type SOURCES ... LINK third-party targets...)
# A part of a module whose third-party libraries take long to load: a library of its own, libdsc_NAME.so, which the core loads
# when it is first needed. NAME_backend.hpp in the module's folder declares the table of functions, a struct named `type`, and
# the function NAME_backend(), which gives it; the function dsc_backend_NAME() of the sources returns its address. Tests, which
# link the module's static library, have the sources linked to it.
function(dsc_backend module name)
  cmake_parse_arguments(arg "" "TYPE" "SOURCES;LINK" ${ARGN})
  set(type ${arg_TYPE})
  set(access ${CMAKE_CURRENT_BINARY_DIR}/${name}_backend_access.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/share/cmake/dsc_backend_access.cpp.in ${access} @ONLY)
  set(include_folders ${PROJECT_SOURCE_DIR}/core/include ${PROJECT_BINARY_DIR}/core/include ${PROJECT_SOURCE_DIR}/core/src)

  add_library(dsc_backend_${name}_objects OBJECT ${arg_SOURCES})
  target_include_directories(dsc_backend_${name}_objects PRIVATE ${include_folders})
  target_link_libraries(dsc_backend_${name}_objects PRIVATE Eigen3::Eigen dsc_flags fmt::fmt ${arg_LINK})
  add_library(dsc_backend_${name} MODULE $<TARGET_OBJECTS:dsc_backend_${name}_objects>)
  target_link_libraries(dsc_backend_${name} PRIVATE dsc_core dsc_flags fmt::fmt ${arg_LINK})
  set_target_properties(dsc_backend_${name} PROPERTIES LINKER_LANGUAGE CXX PREFIX lib OUTPUT_NAME dsc_${name}
    INSTALL_RPATH "$ORIGIN")
  install(TARGETS dsc_backend_${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)

  target_sources(dsc_${module} PRIVATE $<TARGET_OBJECTS:dsc_backend_${name}_objects> ${access})
  target_compile_definitions(dsc_${module} PRIVATE DSC_BACKEND_LINKED)
  target_include_directories(dsc_${module} PRIVATE ${PROJECT_SOURCE_DIR}/core/src)
  target_link_libraries(dsc_${module} PRIVATE dsc_flags fmt::fmt ${arg_LINK})
  set_property(GLOBAL APPEND PROPERTY DSC_BACKENDS dsc_backend_${name})
  set_property(GLOBAL APPEND PROPERTY DSC_BACKEND_ACCESS ${access})
endfunction()

# dsc_unit_test(MODULE SOURCES ... [USES modules...] [LINK targets...] [LABELS ...]): doctest executable test_MODULE.
function(dsc_unit_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;USES;LINK;LABELS" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES} $<TARGET_OBJECTS:dsc_test_main>)
  list(TRANSFORM arg_USES PREPEND dsc_ OUTPUT_VARIABLE used)
  target_link_libraries(test_${name} PRIVATE ${used} dsc_flags doctest::doctest ${arg_LINK})
  target_compile_definitions(test_${name} PRIVATE DSC_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  dsc_quick_test(test_${name})
  set(labels unit ${arg_LABELS})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  doctest_discover_tests(test_${name} TEST_PREFIX "${name}." PROPERTIES LABELS "${labels}" TIMEOUT ${arg_TIMEOUT})
endfunction()
