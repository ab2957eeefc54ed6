# luciole_shaders(TARGET FILES...): compiles GLSL to SPIR-V, warnings as errors, and embeds it: gpu::shaderCode finds each
# by its path below src/. A variant, FILE+WORD+..., has the words defined as macros and is found by that name. Headers are
# tracked, so touching one rebuilds just what includes it.
function(luciole_shaders target)
    set(registry ${CMAKE_CURRENT_BINARY_DIR}/shader_registry.cpp)
    set(words "")
    set(rows "")
    foreach(file ${ARGN})
        string(REPLACE "+" ";-D" definitions ${file})
        list(POP_FRONT definitions source)
        set(source ${CMAKE_CURRENT_SOURCE_DIR}/${source})
        set(name ${CMAKE_CURRENT_SOURCE_DIR}/${file})
        cmake_path(RELATIVE_PATH name BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src)
        set(output ${CMAKE_CURRENT_BINARY_DIR}/${file}.inc)
        cmake_path(GET output PARENT_PATH folder)
        file(MAKE_DIRECTORY ${folder})
        add_custom_command(
            OUTPUT ${output}
            COMMAND Vulkan::glslc --target-env=vulkan1.3 -O -Werror -mfmt=c -I ${PROJECT_SOURCE_DIR}/src -I ${PROJECT_SOURCE_DIR}/include ${definitions}
                    -MD -MF ${output}.d -MT ${output} -o ${output} ${source}
            DEPENDS ${source}
            DEPFILE ${output}.d
            COMMENT "Compiling ${name}"
            VERBATIM)
        list(APPEND outputs ${output})
        string(MAKE_C_IDENTIFIER ${name} identifier)
        string(APPEND words "constexpr uint32_t ${identifier}[] =\n#include \"${output}\"\n;\n")
        string(APPEND rows "    {\"${name}\", ${identifier}},\n")
    endforeach()
    file(CONFIGURE OUTPUT ${registry} @ONLY CONTENT "// Made by cmake/shaders.cmake.
#include \"gpu/shaders.hpp\"

#include <stdexcept>
#include <string>

namespace luciole::gpu {
namespace {
@words@
constexpr struct { std::string_view name; std::span<const uint32_t> code; } kShaders[] = {
@rows@};
}  // namespace

std::span<const uint32_t> shaderCode(std::string_view name) {
    for (const auto& shader : kShaders)
        if (shader.name == name) return shader.code;
    throw std::logic_error(\"no shader \" + std::string(name));
}

}  // namespace luciole::gpu
")
    set_source_files_properties(${registry} PROPERTIES OBJECT_DEPENDS "${outputs}" SKIP_PRECOMPILE_HEADERS ON)
    target_sources(${target} PRIVATE ${registry})
endfunction()
