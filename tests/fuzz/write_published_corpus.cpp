// Writes one reply of every kind of a published server into a folder: what fuzz_published begins with.
#include <cstdio>
#include <fstream>
#include <string>

#include "published_for_tests.h"

using namespace emca::bridge;

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: write_published_corpus FOLDER\n", stderr);
        return 2;
    }
    const test::Show show = test::exampleShow();
    const auto paths = test::examplePaths({3, 4}, 6);
    const auto save = [&](const char* name, char kind, char how, const test::Writer& out) {
        std::ofstream file(std::string(argv[1]) + "/published-" + name, std::ios::binary);
        file.put(kind).put(how).write(reinterpret_cast<const char*>(out.bytes().data()), static_cast<std::streamsize>(out.bytes().size()));
        return file.good();
    };
    test::Writer info, camera, scene, heatMap, pixel, swapped(true);
    test::write(info, show.info);
    test::write(camera, show.camera);
    test::write(scene, show.scene);
    test::write(heatMap, *show.heatMap);
    test::write(pixel, 6, paths);
    test::write(swapped, 5, paths);
    constexpr char kSilent = 64, kSwapped = -128;
    const bool all = save("info", 0, 15, info) && save("camera", 1, 15, camera) && save("scene", 2, 15, scene) && save("heat-map", 2, 3, heatMap) &&
                     save("pixel", 3, kSilent, pixel) && save("swapped", 3, kSwapped, swapped);
    return all ? 0 : 1;
}
