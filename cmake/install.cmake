# What `cmake --install` puts where, and what `cpack` makes of it: a package for Debian. tools/package_tarball makes the other.
include(GNUInstallDirs)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)

# Man pages and completions say what --help says: the program is asked at every build.
set(install_pages ${CMAKE_BINARY_DIR}/install_pages)
add_custom_command(OUTPUT ${install_pages}/lavalight.1
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${install_pages}
    COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tools/install_pages --lavalight $<TARGET_FILE:lavalight> --out ${install_pages}
    DEPENDS lavalight tools/install_pages tools/program_help.py VERBATIM)
add_custom_target(install_pages ALL DEPENDS ${install_pages}/lavalight.1)

install(TARGETS lavalight RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${install_pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
install(FILES ${install_pages}/lavalight DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${install_pages}/_lavalight DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${install_pages}/lavalight.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES packaging/lavalight.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
if(LAVALIGHT_VIEW)
    install(FILES packaging/lavalight.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
    install(FILES packaging/lavalight.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()
install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The package for Debian and its kin: one a release, since each has libraries of its own.
set(release "")
if(EXISTS /etc/os-release)
    file(STRINGS /etc/os-release fields REGEX "^(ID|VERSION_ID)=")
    foreach(field ${fields})
        string(REGEX MATCH "^([A-Z_]+)=\"?([^\"]*)" matched "${field}")
        set(os_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    endforeach()
    string(REPLACE "debian" "deb" release "~${os_ID}${os_VERSION_ID}") # 0.1.0-1~deb12 is older than 0.1.0-1~deb13
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGE_CONTACT "Lavalight authors <lavalight@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "physically based path tracer for glTF 2.0")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Lavalight renders glTF 2.0 by path tracing in Vulkan compute kernels. It needs
no graphics card: Mesa's lavapipe, Vulkan in software, is enough.
.
It checks in continuous integration that a model's picture has not changed,
telling noise from change by statistics. It shows models in a window while
they are rendered, and makes their thumbnails.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1${release})
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_DEPENDS mesa-vulkan-drivers) # lavapipe, the driver; dpkg-shlibdeps finds the libraries
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/debian_files.cmake)
set(CPACK_LAVALIGHT_SOURCE ${CMAKE_SOURCE_DIR})
include(CPack)
