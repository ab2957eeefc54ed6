# Embree::embree, version 4 or 3. By hand, since Debian's package files for Embree 3 name targets that it doesn't ship.
foreach(version 4 3)
    find_path(EMBREE${version}_INCLUDE_DIR embree${version}/rtcore.h)
    find_library(EMBREE${version}_LIBRARY embree${version})
    mark_as_advanced(EMBREE${version}_INCLUDE_DIR EMBREE${version}_LIBRARY)
    if(EMBREE${version}_INCLUDE_DIR AND EMBREE${version}_LIBRARY AND NOT TARGET Embree::embree)
        add_library(Embree::embree UNKNOWN IMPORTED)
        set_target_properties(Embree::embree PROPERTIES
            IMPORTED_LOCATION "${EMBREE${version}_LIBRARY}"
            INTERFACE_INCLUDE_DIRECTORIES "${EMBREE${version}_INCLUDE_DIR}"
            INTERFACE_COMPILE_DEFINITIONS LUCIOLE_EMBREE=${version})
    endif()
endforeach()
if(NOT TARGET Embree::embree)
    message(FATAL_ERROR "Embree 4 or 3 not found: install libembree-dev")
endif()
