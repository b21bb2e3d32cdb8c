# What the maths is made of. Embree 3 and 4 both do.
find_package(TBB CONFIG REQUIRED)
find_package(hwy CONFIG REQUIRED)
if(NOT embree_FOUND)
  find_package(embree 4 CONFIG QUIET)
endif()
if(NOT embree_FOUND)
  find_package(embree 3 CONFIG QUIET)
endif()
find_package(Qhull CONFIG QUIET)

# libnova brings neither a package file nor a pkg-config file.
find_path(NOVA_INCLUDE_DIR libnova/solar.h)
find_library(NOVA_LIBRARY nova)
mark_as_advanced(NOVA_INCLUDE_DIR NOVA_LIBRARY)
if(NOVA_INCLUDE_DIR AND NOVA_LIBRARY AND NOT TARGET nova::nova)
  add_library(nova::nova INTERFACE IMPORTED)
  set_target_properties(nova::nova PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${NOVA_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES "${NOVA_LIBRARY}")
endif()
