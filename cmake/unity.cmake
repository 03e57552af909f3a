# SPDX-License-Identifier: GPL-3.0-or-later
# Groups of sources that are compiled as one. The parsing of deal.II's headers is most of a compilation, so each source joins
# the sources that reach equally many headers:
#   3 deal.II's grids and solvers: one group;
#   2 deal.II's ParameterHandler: one group;
#   1 another header of deal.II: one group;
#   0 no header of deal.II: one group for each room.
# Sources of base and contact stay alone, as programs link them without deal.II and MPI (doc/tutorials/4_own_law.md).
# Sources of kernels (*_kernels.cc, *_kernel.cc, *_factor.cc) have unnamed types of the same names and stay alone.

# Sets OUT to the highest level of the headers that FILE reaches.
function(voussoir_reach file out)
  get_property(level GLOBAL PROPERTY VOUSSOIR_REACH_${file})
  if("${level}" STREQUAL "")
    set(level 0)
    file(STRINGS ${file} lines REGEX "^ *# *include +<")
    foreach(line ${lines})
      string(REGEX REPLACE "^[^<]*<([^>]*)>.*$" "\\1" header "${line}")
      set(found 0)
      if(header MATCHES "^voussoir/")
        voussoir_reach(${CMAKE_SOURCE_DIR}/include/${header} found)
      elseif(header MATCHES "^deal.II/(grid|dofs|fe|numerics|lac)/")
        set(found 3)
      elseif(header MATCHES "^deal.II/base/(parameter_handler|patterns)")
        set(found 2)
      elseif(header MATCHES "^deal.II/")
        set(found 1)
      endif()
      if(found GREATER level)
        set(level ${found})
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY VOUSSOIR_REACH_${file} ${level})
  endif()
  set(${out} ${level} PARENT_SCOPE)
endfunction()

# Compiles TARGET in these groups.
function(voussoir_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    if(NOT source MATCHES "_(kernels?|factor)\\.cc$" AND NOT source MATCHES "/source/(base|contact)/"
       AND source MATCHES "/source/([^/]*)/[^/]*\\.cc$")
      set(room ${CMAKE_MATCH_1})
      voussoir_reach(${source} level)
      if(level GREATER 0)
        set_property(SOURCE ${source} PROPERTY UNITY_GROUP level_${level})
      else()
        set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${room})
      endif()
    endif()
  endforeach()
endfunction()
