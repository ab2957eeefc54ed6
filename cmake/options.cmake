# What every target of ours is compiled with. Link luciole_options privately.
add_library(luciole_options INTERFACE)
target_compile_options(luciole_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wno-missing-field-initializers)
# Designated initialisers that leave members out are how Vulkan structs are written here.
if(LUCIOLE_SANITIZE)
    add_compile_options(-fsanitize=${LUCIOLE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${LUCIOLE_SANITIZE})
endif()

# One room of src/ as a static library: luciole_room(NAME SOURCES ... LINK public-targets... PRIVATE private-targets...)
function(luciole_room name)
    cmake_parse_arguments(ROOM "" "" "SOURCES;LINK;PRIVATE" ${ARGN})
    add_library(luciole_${name} STATIC ${ROOM_SOURCES})
    target_include_directories(luciole_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(luciole_${name} PUBLIC ${ROOM_LINK} PRIVATE luciole_options ${ROOM_PRIVATE})
endfunction()

# One test program: luciole_test(NAME SOURCES ... LINK targets... [LABELS ...]): one CTest test.
function(luciole_test name)
    cmake_parse_arguments(TEST "" "" "SOURCES;LINK;LABELS" ${ARGN})
    add_executable(${name} ${TEST_SOURCES} ${PROJECT_SOURCE_DIR}/tests/main.cpp)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(${name} PRIVATE luciole_options ${TEST_LINK})
    target_compile_definitions(${name} PRIVATE LUCIOLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABELS}" TIMEOUT 1200)
endfunction()
