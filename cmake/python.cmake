# The Python module: lavalight/_lavalight in the build tree, beside the package's own files, so that the build folder can be
# imported from: PYTHONPATH=build/release/python.
find_package(Python 3.10 REQUIRED COMPONENTS Interpreter Development.Module OPTIONAL_COMPONENTS Development.SABIModule)
execute_process(COMMAND ${Python_EXECUTABLE} -m nanobind --cmake_dir OUTPUT_VARIABLE nanobind_ROOT
    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE missing ERROR_QUIET)
if(missing)
    message(FATAL_ERROR "${Python_EXECUTABLE} has no nanobind; run tools/setup --python, and name its Python with "
        "-DPython_EXECUTABLE, or install nanobind")
endif()
find_package(nanobind CONFIG REQUIRED)

file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/python/*.cpp ${CMAKE_SOURCE_DIR}/src/python/*.h)
nanobind_add_module(_lavalight STABLE_ABI NB_STATIC NB_SUPPRESS_WARNINGS ${sources})
target_link_libraries(_lavalight PRIVATE lavalight_cli)
# Symbols of the libraries stay inside: other modules of the process have their own LLVM, fmt or Embree.
target_link_options(_lavalight PRIVATE -Wl,--exclude-libs,ALL -Wl,--as-needed) # the Vulkan loader is opened when it is needed
set_target_properties(_lavalight PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/lavalight)

set(package_folder ${CMAKE_SOURCE_DIR}/python/lavalight)
file(GLOB package RELATIVE ${package_folder} CONFIGURE_DEPENDS ${package_folder}/*.py ${package_folder}/*.pyi ${package_folder}/py.typed
    ${package_folder}/serve/*.py ${package_folder}/serve/page/*)
foreach(name ${package})
    set(file ${package_folder}/${name})
    add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/python/lavalight/${name}
        COMMAND ${CMAKE_COMMAND} -E copy ${file} ${CMAKE_BINARY_DIR}/python/lavalight/${name} DEPENDS ${file} VERBATIM)
    list(APPEND copies ${CMAKE_BINARY_DIR}/python/lavalight/${name})
endforeach()
add_custom_target(python_package ALL DEPENDS _lavalight ${copies})

install(TARGETS _lavalight LIBRARY DESTINATION lavalight COMPONENT python EXCLUDE_FROM_ALL)
foreach(name ${package})
    get_filename_component(folder ${name} DIRECTORY)
    install(FILES ${package_folder}/${name} DESTINATION lavalight/${folder} COMPONENT python EXCLUDE_FROM_ALL)
endforeach()
