# SPDX-License-Identifier: GPL-3.0-or-later
# One static target per room; kernels are compiled once per width (see docs/architecture.md, Lanes).

# GCC 12's range propagation takes a comparison of one-lane vectors for 0 or 1 and folds every hit to a miss.
set(CARDIOID_FLAGS_w1 -march=x86-64-v2 -fno-tree-vrp)
set(CARDIOID_FLAGS_w8 -mavx2 -mfma -mf16c -mbmi -mbmi2)
# GCC 12 warns of its own AVX-512 headers (GCC bug 105593).
set(CARDIOID_FLAGS_w16 ${CARDIOID_FLAGS_w8} -mavx512f -mavx512dq -mavx512vl -mavx512bw -mprefer-vector-width=512
    -Wno-maybe-uninitialized -Wno-uninitialized)
set(CARDIOID_KERNEL_FLAGS -O3 -fno-math-errno -fno-trapping-math -ffp-contract=off)

add_library(cardioid_options INTERFACE)
target_compile_features(cardioid_options INTERFACE cxx_std_20)
target_include_directories(cardioid_options INTERFACE ${PROJECT_SOURCE_DIR}/engine_cpp)
target_compile_options(cardioid_options INTERFACE
    -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi -Wno-ignored-attributes -Werror
    -fvisibility=hidden -fPIC)

# cardioid_room(<room> SOURCES ... DEPENDS <rooms>)
function(cardioid_room room)
    cmake_parse_arguments(A "" "" "SOURCES;DEPENDS" ${ARGN})
    add_library(cardioid_${room} STATIC ${A_SOURCES})
    set_target_properties(cardioid_${room} PROPERTIES LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(cardioid_${room} PUBLIC cardioid_options)
    foreach(dep ${A_DEPENDS})
        target_link_libraries(cardioid_${room} PUBLIC cardioid_${dep})
    endforeach()
endfunction()

# cardioid_kernels(<room> SOURCES ... [LIBRARIES <targets for headers>]): adds the three widths to the room's library
function(cardioid_kernels room)
    cmake_parse_arguments(A "" "" "SOURCES;LIBRARIES" ${ARGN})
    foreach(width 1 8 16)
        set(name cardioid_${room}_w${width})
        add_library(${name} OBJECT ${A_SOURCES})
        target_link_libraries(${name} PRIVATE cardioid_options ${A_LIBRARIES})
        target_compile_definitions(${name} PRIVATE CARDIOID_WIDTH=${width})
        target_compile_options(${name} PRIVATE ${CARDIOID_FLAGS_w${width}} ${CARDIOID_KERNEL_FLAGS})
        set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        target_sources(cardioid_${room} PRIVATE $<TARGET_OBJECTS:${name}>)
    endforeach()
endfunction()

# cardioid_test(<name> SOURCES ... ROOMS ... [WIDTHS 1 8 16] [LABELS ...])
function(cardioid_test name)
    cmake_parse_arguments(A "" "" "SOURCES;ROOMS;WIDTHS;LABELS" ${ARGN})
    if(NOT A_LABELS)
        set(A_LABELS unit)
    endif()
    set(variants "")
    if(A_WIDTHS)
        set(variants ${A_WIDTHS})
    else()
        set(variants 0)
    endif()
    foreach(width ${variants})
        set(target test_${name})
        if(width GREATER 0)
            set(target test_${name}_w${width})
        endif()
        add_executable(${target} ${A_SOURCES})
        target_link_libraries(${target} PRIVATE cardioid_options GTest::gtest GTest::gtest_main)
        target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/unit)
        foreach(room ${A_ROOMS})
            target_link_libraries(${target} PRIVATE cardioid_${room})
        endforeach()
        if(width GREATER 0)
            target_compile_definitions(${target} PRIVATE CARDIOID_WIDTH=${width})
            target_compile_options(${target} PRIVATE ${CARDIOID_FLAGS_w${width}} ${CARDIOID_KERNEL_FLAGS})
            # A machine without the instruction set skips the width by name.
            add_test(NAME ${target} COMMAND ${CMAKE_COMMAND} -DWIDTH=${width} -DEXE=$<TARGET_FILE:${target}>
                     -P ${PROJECT_SOURCE_DIR}/cmake/RunWidth.cmake)
            set_tests_properties(${target} PROPERTIES SKIP_REGULAR_EXPRESSION "CARDIOID_SKIP")
        else()
            add_test(NAME ${target} COMMAND ${target})
        endif()
        set_tests_properties(${target} PROPERTIES LABELS "${A_LABELS}")
    endforeach()
endfunction()
