# osmesa::osmesa, if OSMesa is there. libOSMesa must come before libGL in a program's list of libraries: libosg looks its GL
# functions up by name in that order. Options stand ahead of all libraries, whatever the order in target_link_libraries().
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  unset(__pkg_config_checked_OSMESA CACHE) # or a build folder looks once, and never sees that OSMesa has come or gone
  pkg_check_modules(OSMESA QUIET osmesa)
endif()
if(OSMESA_FOUND AND NOT TARGET osmesa::osmesa)
  add_library(osmesa::osmesa INTERFACE IMPORTED)
  set_target_properties(osmesa::osmesa PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OSMESA_INCLUDE_DIRS}"
    INTERFACE_LINK_OPTIONS "LINKER:--push-state,--no-as-needed,-lOSMesa,--pop-state")
endif()
