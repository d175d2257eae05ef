# Build helpers: libraries per source folder, embedded files, embedded kernels.

add_library(lavalight_options INTERFACE)
# No contraction to fused multiply-adds: the same bits on every processor.
target_compile_options(lavalight_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow
    $<$<BOOL:${LAVALIGHT_WERROR}>:-Werror> -ffp-contract=off)
# The Python module is a shared library of the same objects. Executables have the option, too, for precompiled headers of
# libraries serve them.
target_compile_options(lavalight_options INTERFACE $<$<BOOL:${LAVALIGHT_PYTHON}>:-fPIC>)
# g++ 13 and newer report members of an empty std::optional or std::variant as used uninitialised.
target_compile_options(lavalight_options INTERFACE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-maybe-uninitialized>)
# g++ 13 takes what a view refers to for a part of the view; g++ 14 knows better.
target_compile_options(lavalight_options INTERFACE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,14>>:-Wno-dangling-reference>)
target_include_directories(lavalight_options INTERFACE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/shaders)

# lavalight_library(NAME DEPS ... [PRIVATE_DEPS ...] [EXCLUDE file...] [TOGETHER n]): all of src/NAME and below as lavalight_NAME.
# TOGETHER compiles n files at a time, which read the same headers once. What they name for themselves then has to differ.
function(lavalight_library name)
    cmake_parse_arguments(ARG "" "TOGETHER" "DEPS;PRIVATE_DEPS;EXCLUDE" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp ${CMAKE_SOURCE_DIR}/src/${name}/*.h)
    foreach(file ${ARG_EXCLUDE})
        list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/src/${name}/${file})
    endforeach()
    add_library(lavalight_${name} STATIC ${sources})
    set_target_properties(lavalight_${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_link_libraries(lavalight_${name} PUBLIC lavalight_options ${ARG_DEPS} PRIVATE ${ARG_PRIVATE_DEPS})
    if(ARG_TOGETHER)
        set_target_properties(lavalight_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${ARG_TOGETHER})
    endif()
endfunction()

# lavalight_version(LIB): the values of src/base/version.h, asked of git at every build.
function(lavalight_version lib)
    set(out ${CMAKE_BINARY_DIR}/generated/version_values.cpp)
    add_custom_target(lavalight_version BYPRODUCTS ${out}
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSOURCE=${CMAKE_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
                -DCOMMIT=${LAVALIGHT_COMMIT} -P ${CMAKE_SOURCE_DIR}/cmake/version.cmake VERBATIM)
    target_sources(lavalight_${lib} PRIVATE ${out})
    add_dependencies(lavalight_${lib} lavalight_version)
endfunction()

# lavalight_embed_files(LIB NAMESPACE ns ROOT dir FILES f...): each file's bytes, named by its path below ROOT, found by
# base/embedded_file.h. Paths are absolute.
function(lavalight_embed_files lib)
    cmake_parse_arguments(ARG "" "NAMESPACE;ROOT" "FILES" ${ARGN})
    set(out ${CMAKE_BINARY_DIR}/generated/${ARG_NAMESPACE}_files.cpp)
    set(inputs ${ARG_FILES})
    add_custom_command(OUTPUT ${out}
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAMESPACE=${ARG_NAMESPACE} -DROOT=${ARG_ROOT} "-DFILES=${inputs}"
                -P ${CMAKE_SOURCE_DIR}/cmake/embed_files.cmake
        DEPENDS ${inputs} ${CMAKE_SOURCE_DIR}/cmake/embed_files.cmake VERBATIM)
    target_sources(lavalight_${lib} PRIVATE ${out})
endfunction()

# lavalight_embed_kernels(TARGET [EACH_ACCELERATOR] NAMESPACE ns FILES k.comp...): compiles kernels with the program's own
# compiler, so that a shader error fails the build, inlines them, and embeds the SPIR-V as `ns::find(name)`. EACH_ACCELERATOR:
# those that ask about rays are there once for each accelerator.
function(lavalight_embed_kernels target)
    cmake_parse_arguments(ARG "EACH_ACCELERATOR" "NAMESPACE" "FILES" ${ARGN})
    set(dir ${CMAKE_BINARY_DIR}/generated/${target})
    set(out ${dir}/${ARG_NAMESPACE}.cpp)
    file(GLOB_RECURSE includes CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/*.glsl ${CMAKE_SOURCE_DIR}/shaders/*.h)
    add_custom_command(OUTPUT ${out} ${dir}/${ARG_NAMESPACE}.h
        COMMAND embed_kernels --include ${CMAKE_SOURCE_DIR}/shaders --namespace ${ARG_NAMESPACE}
                --out ${dir} $<$<BOOL:${ARG_EACH_ACCELERATOR}>:--each-accelerator> ${ARG_FILES}
        DEPENDS embed_kernels ${ARG_FILES} ${includes} VERBATIM COMMAND_EXPAND_LISTS)
    target_sources(${target} PRIVATE ${out})
    target_include_directories(${target} PUBLIC ${dir})
endfunction()

# lavalight_shaders_as_cpp(LIB OUT name.h FILES f.glsl...): GLSL that the host runs, as C++ members to be included within a
# struct. Files are named below shaders/.
function(lavalight_shaders_as_cpp lib)
    cmake_parse_arguments(ARG "" "OUT" "FILES" ${ARGN})
    set(dir ${CMAKE_BINARY_DIR}/generated/lavalight_${lib})
    file(GLOB_RECURSE includes CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/*.glsl ${CMAKE_SOURCE_DIR}/shaders/*.h)
    add_custom_command(OUTPUT ${dir}/${ARG_OUT}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${dir}
        COMMAND shaders_as_cpp ${CMAKE_SOURCE_DIR}/shaders ${dir}/${ARG_OUT} ${ARG_FILES}
        DEPENDS shaders_as_cpp ${includes} VERBATIM)
    target_sources(lavalight_${lib} PRIVATE ${dir}/${ARG_OUT})
    target_include_directories(lavalight_${lib} PRIVATE ${dir})
endfunction()
