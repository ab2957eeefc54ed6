#include <luciole/output.hpp>
#include <luciole/renderer.hpp>
#include <luciole/scene_io.hpp>

int main() {
    const luciole::Scene scene = luciole::loadScene("builtin:hall?lights=255");
    luciole::Renderer renderer;  // no window, no GPU needed
    renderer.setScene(scene);
    const luciole::Frame frame = renderer.render({scene.cameras.at(0), {1024, 768}}, {.lighting = "brute-force"});
    luciole::writePng("hall.png", frame.display);
}
