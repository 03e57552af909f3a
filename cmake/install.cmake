# SPDX-License-Identifier: GPL-3.0-or-later
# "cmake --install": the program, the library Voussoir::voussoir with its headers, the scripts that the program runs, the
# examples and the pages. A program of a user finds the library with find_package(Voussoir) (tests/user_project).
# The components program and development are Debian packages (package.cmake), the licence stands there in "copyright".
include(CMakePackageConfigHelpers)

set(VOUSSOIR_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Voussoir)
set(VOUSSOIR_SHARE_DIR ${CMAKE_INSTALL_DATADIR}/voussoir)
set(VOUSSOIR_PYTHON_DIR ${VOUSSOIR_SHARE_DIR}/python CACHE STRING "Where the Python package voussoir is installed, below the prefix")

# libvoussoir.a; the name of the target is the program's.
set_target_properties(voussoir_core PROPERTIES OUTPUT_NAME voussoir EXPORT_NAME voussoir)
add_library(Voussoir::voussoir ALIAS voussoir_core)
target_compile_features(voussoir_core INTERFACE cxx_std_17)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS voussoir_core EXPORT VoussoirTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/voussoir DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT VoussoirTargets NAMESPACE Voussoir:: DESTINATION ${VOUSSOIR_CMAKE_DIR})
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/VoussoirConfig.cmake.in ${CMAKE_BINARY_DIR}/cmake/VoussoirConfig.cmake
  INSTALL_DESTINATION ${VOUSSOIR_CMAKE_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/cmake/VoussoirConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/cmake/VoussoirConfig.cmake ${CMAKE_BINARY_DIR}/cmake/VoussoirConfigVersion.cmake
  DESTINATION ${VOUSSOIR_CMAKE_DIR})

# The program looks for its scripts in ../share/voussoir/scripts (source/base/python_script.cc).
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS voussoir RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The program writes its completion for bash.
install(CODE "execute_process(COMMAND \${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 \"$<TARGET_FILE:voussoir>\" completion bash OUTPUT_FILE \"${CMAKE_BINARY_DIR}/voussoir.bash\" RESULT_VARIABLE status)
  if(status)
    message(FATAL_ERROR \"voussoir completion bash: \${status}\")
  endif()")
install(FILES ${CMAKE_BINARY_DIR}/voussoir.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME voussoir)
install(DIRECTORY scripts/ DESTINATION ${VOUSSOIR_SHARE_DIR}/scripts USE_SOURCE_PERMISSIONS FILES_MATCHING PATTERN "*.py"
  PATTERN __pycache__ EXCLUDE PATTERN mutants.py EXCLUDE PATTERN coverage.py EXCLUDE PATTERN function_lengths.py EXCLUDE
  PATTERN check_imports.py EXCLUDE PATTERN site.py EXCLUDE PATTERN reference.py EXCLUDE)
install(DIRECTORY examples prm meshes studies DESTINATION ${VOUSSOIR_SHARE_DIR} PATTERN __pycache__ EXCLUDE)
# The scripts look for the package in ../python, whichever Python runs them.
install(DIRECTORY python/voussoir DESTINATION ${VOUSSOIR_PYTHON_DIR} PATTERN __pycache__ EXCLUDE)
if(VOUSSOIR_PYTHON_DIR STREQUAL "${VOUSSOIR_SHARE_DIR}/python") # for pip; Python's own directory wants no such file
  install(FILES python/pyproject.toml DESTINATION ${VOUSSOIR_PYTHON_DIR})
else()
  file(RELATIVE_PATH package /${VOUSSOIR_SHARE_DIR}/python /${VOUSSOIR_PYTHON_DIR}/voussoir)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/python)
  file(CREATE_LINK ${package} ${CMAKE_BINARY_DIR}/python/voussoir SYMBOLIC)
  install(FILES ${CMAKE_BINARY_DIR}/python/voussoir DESTINATION ${VOUSSOIR_SHARE_DIR}/python)
endif()
install(FILES README.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY doc DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.gif" PATTERN "*.svg")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
unset(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME)

include(${CMAKE_SOURCE_DIR}/cmake/package.cmake)
