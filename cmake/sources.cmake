# Libraries from sources that tools/setup fetches: those that Debian lacks, or has too old.
include(CheckCXXSourceCompiles)

if(DEFINED ENV{XDG_DATA_HOME} AND NOT "$ENV{XDG_DATA_HOME}" STREQUAL "")
    set(lavalight_data $ENV{XDG_DATA_HOME})
else()
    set(lavalight_data $ENV{HOME}/.local/share)
endif()
set(LAVALIGHT_SOURCES ${lavalight_data}/lavalight/sources CACHE PATH "Sources of libraries that tools/setup has fetched")
option(LAVALIGHT_BASISU "Read KTX2 pictures of Basis Universal (ETC1S, UASTC)" ON)

# basisu: the transcoder of Basis Universal. src/image undoes Zstandard before it.
set(fetched ${LAVALIGHT_SOURCES}/basisu-2.50/transcoder)
if(LAVALIGHT_BASISU AND EXISTS ${fetched}/basisu_transcoder.cpp)
    # A Huffman table of one long code has a tree without that code's sibling, which damaged streams read behind the tree's end.
    set(basisu ${CMAKE_BINARY_DIR}/sources/basisu)
    file(GLOB files ${fetched}/*)
    file(COPY ${files} DESTINATION ${basisu})
    file(READ ${fetched}/basisu_transcoder_internal.h header)
    set(unchecked "sym = ct.m_tree[~sym + ((m_bit_buf >> code_len++) & 1)]; // ~sym = -sym - 1")
    set(checked "const uint32_t at = ~sym + ((m_bit_buf >> code_len++) & 1); sym = at < ct.m_tree.size() ? ct.m_tree[at] : 0;")
    string(REPLACE "${unchecked}" "${checked}" mended "${header}")
    if(mended STREQUAL header)
        message(FATAL_ERROR "cannot mend ${fetched}/basisu_transcoder_internal.h: it is not the one that is known; run tools/setup")
    endif()
    file(CONFIGURE OUTPUT ${basisu}/basisu_transcoder_internal.h CONTENT "${mended}" @ONLY)
    add_library(basisu STATIC ${basisu}/basisu_transcoder.cpp)
    target_include_directories(basisu SYSTEM PUBLIC ${basisu})
    target_compile_definitions(basisu PUBLIC BASISD_SUPPORT_KTX2_ZSTD=0 PRIVATE NDEBUG)
    target_compile_options(basisu PRIVATE -w -O2 -fno-strict-aliasing)
    set_target_properties(basisu PROPERTIES POSITION_INDEPENDENT_CODE ON)
elseif(LAVALIGHT_BASISU)
    message(STATUS "KTX2 pictures of Basis Universal will be refused: tools/setup has not fetched its transcoder")
endif()

# meshoptimizer: the system's where it decodes what files of today hold (1.0 and newer), else from its sources.
find_package(meshoptimizer REQUIRED)
set(CMAKE_REQUIRED_LIBRARIES meshoptimizer::meshoptimizer)
check_cxx_source_compiles("
#include <meshoptimizer.h>
#if MESHOPTIMIZER_VERSION < 1000
#error too old
#endif
int main() {}" LAVALIGHT_SYSTEM_MESHOPTIMIZER)
unset(CMAKE_REQUIRED_LIBRARIES)
set(meshoptimizer ${LAVALIGHT_SOURCES}/meshoptimizer-1.3)
if(NOT LAVALIGHT_SYSTEM_MESHOPTIMIZER AND EXISTS ${meshoptimizer}/vertexcodec.cpp)
    add_library(lavalight_meshoptimizer STATIC ${meshoptimizer}/vertexcodec.cpp ${meshoptimizer}/vertexfilter.cpp
        ${meshoptimizer}/indexcodec.cpp ${meshoptimizer}/allocator.cpp)
    target_include_directories(lavalight_meshoptimizer SYSTEM PUBLIC ${meshoptimizer})
    target_compile_options(lavalight_meshoptimizer PRIVATE -w -O2)
    set_target_properties(lavalight_meshoptimizer PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_definitions(lavalight_meshoptimizer PRIVATE NDEBUG)
else()
    add_library(lavalight_meshoptimizer INTERFACE)
    target_link_libraries(lavalight_meshoptimizer INTERFACE meshoptimizer::meshoptimizer)
    if(NOT LAVALIGHT_SYSTEM_MESHOPTIMIZER)
        message(STATUS "Newer meshopt streams will be refused: the system's meshoptimizer is old, and tools/setup has not "
            "fetched a newer one")
    endif()
endif()
