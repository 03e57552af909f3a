# SPDX-License-Identifier: GPL-3.0-or-later
# The target "doc": the sources' documentation by Doxygen, without warnings.
find_program(DOXYGEN_EXECUTABLE doxygen)
if(DOXYGEN_EXECUTABLE)
  configure_file(${CMAKE_SOURCE_DIR}/doc/Doxyfile.in ${CMAKE_BINARY_DIR}/doc/Doxyfile @ONLY)
  add_custom_target(doc COMMAND ${DOXYGEN_EXECUTABLE} ${CMAKE_BINARY_DIR}/doc/Doxyfile
    COMMENT "Documentation of the sources: ${CMAKE_BINARY_DIR}/doc/html/index.html" VERBATIM)
endif()
