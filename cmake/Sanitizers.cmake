# SPDX-License-Identifier: GPL-3.0-or-later
# -DCARDIOID_SANITIZE=address|undefined|thread instruments everything that is built here (see CMakePresets.json).
# Kernels are compiled at all widths as usual, so the sanitizers see the code that ships.

set(CARDIOID_SANITIZE "" CACHE STRING "address, undefined, thread, or empty")
set_property(CACHE CARDIOID_SANITIZE PROPERTY STRINGS "" address undefined thread)

if(CARDIOID_SANITIZE)
    if(NOT CARDIOID_SANITIZE MATCHES "^(address|undefined|thread)$")
        message(FATAL_ERROR "CARDIOID_SANITIZE is '${CARDIOID_SANITIZE}': address, undefined or thread")
    endif()
    add_compile_options(-fsanitize=${CARDIOID_SANITIZE} -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${CARDIOID_SANITIZE})
endif()
