# What Debian's policy asks of a package beyond an installation: changelogs, and compressed pages. CPack runs it before it packs.
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH, where it is set
set(doc ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc/lavalight)
file(WRITE ${doc}/changelog.Debian "lavalight (${version}) unstable; urgency=medium

  * Version ${CPACK_PACKAGE_VERSION}: see changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
configure_file(${CPACK_LAVALIGHT_SOURCE}/CHANGELOG.md ${doc}/changelog COPYONLY)
file(GLOB pages ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/man/man1/*.1)
execute_process(COMMAND gzip -9n ${doc}/changelog.Debian ${doc}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
