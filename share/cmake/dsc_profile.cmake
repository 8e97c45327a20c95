# Profile-guided optimisation, for packagers; needs g++. With DSC_PROFILE=use (preset pgo), configuring builds the project once
# with counters, in training/ of the build folder, runs a few experiments with it, and takes the counts for this build. A second
# configuring uses the same counts; remove the build folder to count again. Results keep the same bits.
set(DSC_PROFILE "" CACHE STRING "Profile-guided optimisation: empty, use, or generate (the build that counts)")
set(DSC_PROFILE_FOLDER "${CMAKE_BINARY_DIR}/profile" CACHE PATH "Folder of the counts")

function(_dsc_execute)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Reconstruction, the steps of the thesis, and changes of topology; on the built-in shapes, because others are not at hand.
function(_dsc_train program folder)
  set(configs ${PROJECT_SOURCE_DIR}/configs)
  file(MAKE_DIRECTORY ${folder})
  _dsc_execute(${program} sample teapot -n 1200 -o ${folder}/teapot.obj)
  _dsc_execute(${program} run ${configs}/quickstart.yaml -o ${folder}/quickstart --progress never)
  _dsc_execute(${CMAKE_COMMAND} -E env DSC_DATA=${folder} ${program} run ${configs}/thesis/teapot.yaml -o ${folder}/thesis
    --progress never)
  foreach(demo IN ITEMS merge_spheres split_dumbbell)
    _dsc_execute(${program} run ${configs}/demos/${demo}.yaml -o ${folder}/${demo} --progress never)
  endforeach()
endfunction()

function(_dsc_count)
  set(training ${CMAKE_BINARY_DIR}/training)
  message(STATUS "Profile-guided optimisation: the build that counts is in ${training}")
  _dsc_execute(${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${training} -G ${CMAKE_GENERATOR}
    -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_UNITY_BUILD=${CMAKE_UNITY_BUILD}
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=${CMAKE_UNITY_BUILD_BATCH_SIZE} -DDSC_BUILD_TESTS=OFF -DDSC_PYTHON=OFF
    -DDSC_PROFILE=generate -DDSC_PROFILE_FOLDER=${DSC_PROFILE_FOLDER})
  _dsc_execute(${CMAKE_COMMAND} --build ${training})
  _dsc_train(${training}/bin/dsc ${training}/runs)
  file(TOUCH ${DSC_PROFILE_FOLDER}/complete)
endfunction()

if(DSC_PROFILE AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  message(FATAL_ERROR "DSC_PROFILE needs g++, not ${CMAKE_CXX_COMPILER}")
endif()
# Two builds in different folders share the counts, so names in them are relative to the build folder.
set(profile_paths -fprofile-prefix-path=${CMAKE_BINARY_DIR})
if(DSC_PROFILE STREQUAL "generate")
  target_compile_options(dsc_flags INTERFACE -fprofile-generate=${DSC_PROFILE_FOLDER} -fprofile-update=prefer-atomic ${profile_paths})
  target_link_options(dsc_flags INTERFACE -fprofile-generate)
elseif(DSC_PROFILE STREQUAL "use")
  if(NOT EXISTS ${DSC_PROFILE_FOLDER}/complete)
    _dsc_count()
  endif()
  # A source that is newer than the counts, or was not run, is compiled as without them.
  target_compile_options(dsc_flags INTERFACE -fprofile-use=${DSC_PROFILE_FOLDER} ${profile_paths} -fprofile-partial-training
    -Wno-missing-profile -Wno-coverage-mismatch)
elseif(NOT DSC_PROFILE STREQUAL "")
  message(FATAL_ERROR "DSC_PROFILE=${DSC_PROFILE}: accepted are use and generate")
endif()
