# The Debian package, made by CPack from what `cmake --install` would install: `cpack -G DEB` in a build folder.
# share/setup.sh package builds the release preset and calls it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dsc)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "the dsc authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "surfaces and volume meshes from point clouds by deformable simplicial complexes")
set(CPACK_PACKAGE_DESCRIPTION
"The command dsc reconstructs a closed surface from a point cloud without
normals, together with a tetrahedral mesh inside and outside of it. The
surface cannot cross itself. Experiments are written in YAML; velocity
fields, curvature estimators, refinement policies and other strategies are
plugins.
.
The package contains the command, the strategies, the library with its
headers and its CMake package, the Python package, and the documentation.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_VERBATIM_VARIABLES TRUE)

set(CPACK_DEB_COMPONENT_INSTALL OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
# Shared libraries and their versions are read from the binaries. A plugin compiles against Eigen's headers.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev, python3, python3-numpy")
if(DSC_BUILD_PYTHON)  # the extension module belongs to one minor version of Python
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS
    ", python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${Python3_VERSION_MAJOR}.${next_minor}), python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "cmake, g++, doctest-dev")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/dsc COMPONENT program)

include(CPack)
