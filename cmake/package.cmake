# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages by "cpack -G DEB" (scripts/package.sh): voussoir, the program, and voussoir-dev, the library. What Debian's
# policy asks for besides the files of an installation: copyright, changelog, a page of the manual, and compiled scripts.
set(VOUSSOIR_PACKAGER "The authors of Voussoir <packages@voussoir.invalid>" CACHE STRING "Maintainer of the Debian packages")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH, where that is set
string(TIMESTAMP day "%Y-%m-%d" UTC)
set(debian ${CMAKE_BINARY_DIR}/debian)
set(PACKAGE_DATE ${date})
set(PACKAGE_DAY ${day})
foreach(name changelog voussoir.1)
  configure_file(${CMAKE_SOURCE_DIR}/cmake/debian/${name}.in ${debian}/${name} @ONLY)
endforeach()

find_program(GZIP_EXECUTABLE gzip)
if(GZIP_EXECUTABLE)
  execute_process(COMMAND ${GZIP_EXECUTABLE} -9nkf changelog voussoir.1 WORKING_DIRECTORY ${debian})
  install(FILES ${debian}/voussoir.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
endif()
set(docdir_program ${CMAKE_INSTALL_DATADIR}/doc/voussoir)
set(docdir_development ${CMAKE_INSTALL_DATADIR}/doc/voussoir-dev)
foreach(component program development)
  # Nothing of this is in "cmake --install", but in packages alone.
  install(FILES ${CMAKE_SOURCE_DIR}/cmake/debian/copyright ${debian}/changelog.gz DESTINATION ${docdir_${component}}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME voussoir)
set(CPACK_PACKAGE_CONTACT ${VOUSSOIR_PACKAGER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "earthquake analysis of arch dams with contraction joints")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Computes how the contraction joints of a concrete arch dam open, close and
slide in an earthquake, and what that does to its stresses: node-to-node
contact with friction, shear keys or cohesion by a semismooth Newton method,
on a rigid base, on massless rock, or on explicit rock with a transmitting
boundary. It draws its figures and writes a report.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"The library of Voussoir with its headers, for programs that use its contact
solver, its joint laws or its dams: find_package(Voussoir) in CMake.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME voussoir)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The figures and most commands need matplotlib; the rest is for one command each, and named by it where it is missing.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "python3, python3-matplotlib")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libjs-dygraphs, libjs-three, python3-meshio, snakemake")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "chromium, gmsh, openmpi-bin, paraview, voussoir-dev")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/debian/postinst ${CMAKE_SOURCE_DIR}/cmake/debian/prerm)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME voussoir-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libdeal.ii-dev, libgmsh-dev, libopenblas-dev, libsuitesparse-dev, mold")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "voussoir (= ${PROJECT_VERSION}), cmake")
include(CPack)
