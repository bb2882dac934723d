// Structs of renderers that were compiled for other versions.
#include <cstring>
#include <string>
#include <vector>

#include "everything.h"
#include "served_in_c.h"

namespace emca::test {
namespace {

/// Memory of exactly so many bytes, as a sanitizer sees it: what is read beyond is found.
template <typename T>
class Sized {
  public:
    Sized(const T& value, std::size_t bytes, unsigned char beyond = 0) : memory_(bytes, beyond) {
        std::memcpy(memory_.data(), &value, std::min(bytes, sizeof value));
        const auto size = static_cast<std::uint32_t>(bytes);
        std::memcpy(memory_.data(), &size, sizeof size);
    }
    const T* get() const { return reinterpret_cast<const T*>(memory_.data()); }

  private:
    std::vector<unsigned char> memory_;
};

emca_code start(const emca_renderer* renderer, const emca_server_options* options, std::string* message = nullptr) {
    emca_server* server = nullptr;
    emca_error error{};
    const emca_code code = emca_server_start(renderer, options, &server, &error);
    EXPECT_EQ(server != nullptr, code == EMCA_OK);
    EXPECT_EQ(error.code, code);
    EXPECT_EQ(error.message[0] == 0, code == EMCA_OK);
    if (message) *message = error.message;
    emca_server_destroy(server);
    return code;
}

constexpr std::size_t kFirstRenderer = offsetof(emca_renderer, render_pixels);

TEST(StructsInC, OfAnOldRendererAreServed) {
    const Sized<emca_renderer> old(everything(), kFirstRenderer);
    emca_server_options options = {EMCA_SIZED(emca_server_options), .port = 0, .allow_quit = true};
    const Sized<emca_server_options> oldOptions(options, offsetof(emca_server_options, maximum_clients));
    emca_server* server = nullptr;
    emca_error error{};
    ASSERT_EQ(emca_server_start(old.get(), oldOptions.get(), &server, &error), EMCA_OK) << error.message;
    auto connection = client::Connection::open({"127.0.0.1", emca_server_port(server)});
    ASSERT_TRUE(connection.ok());
    ASSERT_TRUE((*connection)->render().ok());
    const auto trace = (*connection)->tracePixel({1, 1});
    ASSERT_TRUE(trace.ok());
    EXPECT_EQ(trace->replays.at(0).verdict, Verdict::exact);
    EXPECT_TRUE((*connection)->quitServer().ok()) << "of the options that it had";
    emca_server_wait(server);
    (*connection).reset();
    emca_server_destroy(server);
}

TEST(StructsInC, OfANewerRendererAreServedIfTheyAskForNothingNew) {
    EXPECT_EQ(start(Sized<emca_renderer>(everything(), sizeof(emca_renderer) + 24).get(), nullptr), EMCA_OK);
    std::string message;
    EXPECT_EQ(start(Sized<emca_renderer>(everything(), sizeof(emca_renderer) + 24, 1).get(), nullptr, &message),
              EMCA_VERSION_MISMATCH);
    EXPECT_NE(message.find("install a newer"), std::string::npos) << message;
}

TEST(StructsInC, OfSizesThatCannotBeAreRefused) {
    for (const std::size_t bytes : {std::size_t(8), kFirstRenderer - 1})
        EXPECT_EQ(start(Sized<emca_renderer>(everything(), bytes).get(), nullptr), EMCA_INVALID_ARGUMENT) << bytes;
    emca_renderer renderer = everything();
    renderer.size = 0xffffffff;
    EXPECT_EQ(start(&renderer, nullptr), EMCA_INVALID_ARGUMENT);
    const emca_renderer zero = {};
    std::string message;
    EXPECT_EQ(start(&zero, nullptr, &message), EMCA_INVALID_ARGUMENT);
    EXPECT_NE(message.find("EMCA_SIZED(emca_renderer)"), std::string::npos) << message;
    const emca_server_options options = {};
    renderer = everything();
    EXPECT_EQ(start(&renderer, &options), EMCA_INVALID_ARGUMENT);
}

TEST(StructsInC, OfOtherVersionsAreRefused) {
    for (const std::uint32_t version : {0u, EMCA_ABI + 1, (EMCA_ABI_MAJOR + 1u) << 16, (EMCA_ABI_MAJOR - 1u) << 16}) {
        emca_renderer renderer = everything();
        renderer.version = version;
        EXPECT_EQ(start(&renderer, nullptr), EMCA_VERSION_MISMATCH) << version;
    }
}

TEST(StructsInC, ThatLackFunctionsAreRefusedByName) {
    EXPECT_EQ(start(nullptr, nullptr), EMCA_INVALID_ARGUMENT);
    const emca_renderer whole = everything();
    EXPECT_EQ(emca_server_start(&whole, nullptr, nullptr, nullptr), EMCA_INVALID_ARGUMENT);
    const auto refused = [&](const char* function, auto change) {
        emca_renderer renderer = whole;
        change(renderer);
        std::string message;
        EXPECT_EQ(start(&renderer, nullptr, &message), EMCA_INVALID_ARGUMENT);
        EXPECT_NE(message.find(function), std::string::npos) << message;
    };
    refused("info", [](emca_renderer& r) { r.info = nullptr; });
    refused("camera", [](emca_renderer& r) { r.camera = nullptr; });
    refused("meshes", [](emca_renderer& r) { r.meshes = nullptr; });
    refused("render_image", [](emca_renderer& r) { r.render_image = nullptr; });
    refused("render_pixel", [](emca_renderer& r) { r.render_pixel = nullptr; });
    refused("surface_layers", [](emca_renderer& r) {
        r.surface_layers = [](void*, emca_layer_list*, emca_error*) -> emca_code { return EMCA_OK; };
    });
}

TEST(StructsInC, OfMeshesAreChecked) {
    emca_renderer renderer = everything();
    static std::string wrong;
    renderer.meshes = [](void*, emca_mesh_list* list, emca_error* error) -> emca_code {
        const emca_vec3f positions[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        const std::uint32_t triangle[3] = {0, 1, 3};
        emca_mesh mesh = {EMCA_SIZED(emca_mesh), .name = "bad",       .positions = positions,
                          .triangles = triangle, .position_count = 3, .triangle_count = 1};
        if (emca_add_mesh(list, nullptr, nullptr) != EMCA_INVALID_ARGUMENT) wrong = "null mesh";
        if (emca_add_mesh(nullptr, &mesh, nullptr) != EMCA_INVALID_ARGUMENT) wrong = "null list";
        mesh.positions = nullptr;
        if (emca_add_mesh(list, &mesh, nullptr) != EMCA_INVALID_ARGUMENT) wrong = "null positions";
        mesh.positions = positions;
        return emca_add_mesh(list, &mesh, error);
    };
    ServedInC served(renderer);
    const auto meshes = served.client().meshes();
    EXPECT_EQ(wrong, "");
    ASSERT_FALSE(meshes.ok());
    EXPECT_NE(meshes.error().message.find("bad"), std::string::npos) << meshes.error().message;
}

TEST(StructsInC, OfLayersAreChecked) {
    emca_renderer renderer = everything();
    renderer.render_image_with_layers = [](void*, const emca_settings*, emca_surface*, emca_monitor*, emca_image*,
                                           emca_error*) -> emca_code { return EMCA_OK; };
    renderer.surface_layers = [](void*, emca_layer_list* list, emca_error* error) -> emca_code {
        const emca_layer_description layer = {EMCA_SIZED(emca_layer_description), .name = "layer", .kind = 4};
        return emca_add_layer(list, &layer, error);
    };
    std::string message;
    EXPECT_EQ(start(&renderer, nullptr, &message), EMCA_RENDERER_FAILED);
    EXPECT_NE(message.find("kind 4"), std::string::npos) << message;
}

}  // namespace
}  // namespace emca::test
