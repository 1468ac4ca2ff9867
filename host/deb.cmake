# `cpack -G DEB` in the build folder: one Debian package of what is installed, for the release that it is built on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of clvndf <clvndf@localhost>")
set(CPACK_PACKAGE_DESCRIPTION
"The command clvndf lists OpenCL devices, writes the kernels of a renderer, evaluates
them, and checks a device against a double-precision reference. With it come the
headers for OpenCL C, C, C++ and CUDA, also as strings, for CMake and pkg-config.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
include(CPack)
