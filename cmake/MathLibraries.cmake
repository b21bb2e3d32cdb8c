# Looks for what the maths is made of, quietly: the targets TBB::tbb, embree, Qhull::qhullcpp, Qhull::qhull_r and
# nova::nova. A target that the user's project has already is taken as it is.
# gnomon_embree_versions: the major versions of Embree that may be taken. What embree_DIR names goes ahead of the others.
if(NOT TARGET TBB::tbb)
  find_package(TBB CONFIG QUIET)
endif()
if(NOT TARGET TBB::tbb) # without it, Embree's own file would stop CMake
  return()
endif()
set(gnomon_embree_dir ${embree_DIR}) # find_package() overwrites it where the version is another
foreach(gnomon_search NO_DEFAULT_PATH "")
  foreach(gnomon_version ${gnomon_embree_versions})
    if(NOT TARGET embree)
      if(gnomon_embree_dir)
        set(embree_DIR ${gnomon_embree_dir} CACHE PATH "Folder of embree-config.cmake" FORCE)
      endif()
      find_package(embree ${gnomon_version} CONFIG QUIET ${gnomon_search})
    endif()
  endforeach()
endforeach()
if(NOT TARGET Qhull::qhullcpp)
  find_package(Qhull CONFIG QUIET)
endif()

# libnova brings neither a package file nor a pkg-config file.
find_path(NOVA_INCLUDE_DIR libnova/solar.h)
find_library(NOVA_LIBRARY nova)
mark_as_advanced(NOVA_INCLUDE_DIR NOVA_LIBRARY)
if(NOVA_INCLUDE_DIR AND NOVA_LIBRARY AND NOT TARGET nova::nova)
  add_library(nova::nova INTERFACE IMPORTED)
  set_target_properties(nova::nova PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${NOVA_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES "${NOVA_LIBRARY}")
endif()
