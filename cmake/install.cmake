# SPDX-License-Identifier: GPL-3.0-or-later
# "cmake --install": the program, the library Voussoir::voussoir with its headers, the scripts that the program runs, and
# the examples. A program of a user finds the library with find_package(Voussoir) (tests/user_project).
include(CMakePackageConfigHelpers)

set(VOUSSOIR_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Voussoir)
set(VOUSSOIR_SHARE_DIR ${CMAKE_INSTALL_DATADIR}/voussoir)

# libvoussoir.a; the name of the target is the program's.
set_target_properties(voussoir_core PROPERTIES OUTPUT_NAME voussoir EXPORT_NAME voussoir)
add_library(Voussoir::voussoir ALIAS voussoir_core)
target_compile_features(voussoir_core INTERFACE cxx_std_17)

install(TARGETS voussoir_core EXPORT VoussoirTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS voussoir RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/voussoir DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT VoussoirTargets NAMESPACE Voussoir:: DESTINATION ${VOUSSOIR_CMAKE_DIR})
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/VoussoirConfig.cmake.in ${CMAKE_BINARY_DIR}/cmake/VoussoirConfig.cmake
  INSTALL_DESTINATION ${VOUSSOIR_CMAKE_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/cmake/VoussoirConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/cmake/VoussoirConfig.cmake ${CMAKE_BINARY_DIR}/cmake/VoussoirConfigVersion.cmake
  DESTINATION ${VOUSSOIR_CMAKE_DIR})

# The program looks for its scripts in ../share/voussoir/scripts (source/base/python_script.cc).
install(DIRECTORY scripts/ DESTINATION ${VOUSSOIR_SHARE_DIR}/scripts USE_SOURCE_PERMISSIONS FILES_MATCHING PATTERN "*.py"
  PATTERN "*.css" PATTERN __pycache__ EXCLUDE PATTERN mutants.py EXCLUDE PATTERN function_lengths.py EXCLUDE)
install(DIRECTORY prm meshes studies python DESTINATION ${VOUSSOIR_SHARE_DIR} PATTERN __pycache__ EXCLUDE)
install(FILES README.md LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
