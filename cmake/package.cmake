# What `cmake --install` installs, and what `cpack` packs of it: a .deb, its debug symbols, and a .tar.gz that runs from any folder.
foreach(file man/volumen.1 package/changelog)
  get_filename_component(name ${file} NAME)
  add_custom_command(OUTPUT ${name}.gz DEPENDS ${PROJECT_SOURCE_DIR}/resources/${file} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/resources/${file} ${name}
    COMMAND gzip -9nf ${name})
endforeach()
add_custom_target(volumen_compressed ALL DEPENDS volumen.1.gz changelog.gz)
add_dependencies(volumen volumen_compressed)

# volumen_install(FOLDER FILE...): into a folder of share.
function(volumen_install folder)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/resources/ OUTPUT_VARIABLE files REGEX "^[^/].*")
  install(FILES ${files} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder})
endfunction()
install(TARGETS volumen RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
volumen_install(applications desktop/volumen.desktop)
volumen_install(mime/packages desktop/volumen.xml)
volumen_install(metainfo desktop/io.github.volumen.volumen.metainfo.xml)
volumen_install(icons/hicolor/scalable/apps icons/volumen.svg)
volumen_install(bash-completion/completions completion/volumen)
volumen_install(man/man1 ${PROJECT_BINARY_DIR}/volumen.1.gz)
volumen_install(doc/volumen package/copyright ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_BINARY_DIR}/changelog.gz)

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_VENDOR "The volumen project")
set(CPACK_PACKAGE_CONTACT "volumen maintainers <maintainers@volumen.invalid>" CACHE STRING "The maintainer that the package names")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "DICOM workstation without a GPU")
set(CPACK_PACKAGE_DESCRIPTION "volumen opens what a hospital sends (CT, MR, PET and other scans), shows
slices and frames, measures, segments, and draws volumes in 3D with correct
light, on the CPU. Every picture states its error against a reference.

It is not for clinical use.")
set(CPACK_PACKAGE_FILE_NAME ${PROJECT_NAME}-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Plugins, which the program loads where no library names them: the window on X and the index; OpenGL of the CPU; films.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "qt6-qpa-plugins, libqt6sql6-sqlite")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, libegl-mesa0, libegl1, libgl1")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg")
set(CPACK_DEBIAN_DEBUGINFO_PACKAGE ON)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/complete_symbols.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/strip_tar.cmake)
include(CPack)
