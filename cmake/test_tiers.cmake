# How suites of tests run: as shards of one process each, or in one process a test. Each run has the label of its tier.
#
#   fast        no device: under a minute          faults      what fails on purpose: drivers, memory, disks
#   device      kernels and programs: 4 minutes    nightly     hours: run by tools/test --all
#   statistics  pictures judged by their noise
#
# tools/check_tiers fails unless each test runs in exactly one tier.

# Seconds after which a shard or a test counts as hung.
set(lavalight_test_timeout 600)

# lavalight_run(SUITE TIER [NAME name] [SHARDS n | EACH] [ONLY pattern...] [EXCEPT pattern...]): tests of a suite, chosen by
# patterns of --gtest_filter. The shards of one process each, `name/2-of-3`, share a device and its compiled kernels; EACH
# test gets a process where it needs one, a desktop for example.
function(lavalight_run suite tier)
    cmake_parse_arguments(ARG "EACH" "NAME;SHARDS" "ONLY;EXCEPT" ${ARGN})
    if(NOT ARG_NAME)
        set(ARG_NAME ${suite})
    endif()
    if(NOT ARG_SHARDS)
        set(ARG_SHARDS 1)
    endif()
    list(JOIN ARG_ONLY ":" filter)
    if(ARG_EXCEPT)
        list(JOIN ARG_EXCEPT ":" except)
        string(APPEND filter "-${except}")
    elseif(NOT ARG_ONLY)
        set(filter "*")
    endif()
    if(ARG_EACH)
        gtest_discover_tests(${suite} TEST_PREFIX "${ARG_NAME}/" TEST_FILTER "${filter}" DISCOVERY_TIMEOUT 120
            PROPERTIES TIMEOUT ${lavalight_test_timeout} LABELS ${tier})
        return()
    endif()
    math(EXPR last "${ARG_SHARDS} - 1")
    foreach(index RANGE ${last})
        math(EXPR number "${index} + 1")
        set(test ${ARG_NAME}/${number}-of-${ARG_SHARDS})
        add_test(NAME ${test} COMMAND ${suite} --gtest_filter=${filter})
        set_tests_properties(${test} PROPERTIES LABELS ${tier} TIMEOUT ${lavalight_test_timeout}
            ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${index}")
    endforeach()
endfunction()

# lavalight_script_test(NAME TIER COMMAND...): a tool that checks the tree.
function(lavalight_script_test name tier)
    add_test(NAME ${name} COMMAND ${ARGN})
    set_tests_properties(${name} PROPERTIES LABELS ${tier} TIMEOUT ${lavalight_test_timeout})
endfunction()
