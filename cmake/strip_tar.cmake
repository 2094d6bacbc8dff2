# Read by cpack for each kind of package: symbols of the .deb go into a package of their own once it is laid out, those of the .tar.gz are dropped.
if(CPACK_GENERATOR STREQUAL TGZ)
  set(CPACK_STRIP_FILES ON)
endif()
