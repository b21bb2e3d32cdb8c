# Parts that a build may leave out, each with the library that it needs. GNOMON_WITH_<LIBRARY> is
#   AUTO  the part is there if its library is found, with headers (the default)
#   ON    a missing library is an error
#   OFF   the part is left out
# gnomon_optional_part(COMPONENT LIBRARY TARGET PACKAGE WORK) sets GNOMON_HAS_<LIBRARY>, and GNOMON_MISSING_<COMPONENT>: the
# sentence that find_package(gnomon) and the library itself say where the part is missed, or nothing.
foreach(library EMBREE QHULL LIBNOVA OSMESA EGL)
  set(GNOMON_WITH_${library} AUTO CACHE STRING "Build the part that needs this library: AUTO, ON or OFF")
  set_property(CACHE GNOMON_WITH_${library} PROPERTY STRINGS AUTO ON OFF)
endforeach()

function(gnomon_optional_part component library target package work)
  string(TOUPPER ${library} upper)
  set(option GNOMON_WITH_${upper})
  set(has OFF)
  set(missing "This Gnomon was built without ${library}, which ${work}. Install ${package}, and build Gnomon with -D${option}=ON.")
  if(${option} AND TARGET ${target})
    set(has ON)
    set(missing "")
  elseif(${option} AND NOT ${option} STREQUAL "AUTO")
    message(FATAL_ERROR "${option} is ON, but ${library} is not found. Install ${package}, or set -D${option}=AUTO.")
  endif()
  set(GNOMON_HAS_${upper} ${has} PARENT_SCOPE)
  set(GNOMON_MISSING_${component} "${missing}" PARENT_SCOPE)
  set(GNOMON_COMPONENTS ${GNOMON_COMPONENTS} ${component} PARENT_SCOPE)
endfunction()

# gnomon_require_parts(WHO): stops where anything is missing that WHO needs, which is all.
function(gnomon_require_parts who)
  foreach(component ${GNOMON_COMPONENTS})
    if(GNOMON_MISSING_${component})
      message(FATAL_ERROR "${who} need the component ${component}. ${GNOMON_MISSING_${component}}")
    endif()
  endforeach()
endfunction()
