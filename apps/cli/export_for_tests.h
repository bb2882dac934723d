#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "json.h"
#include "program_for_tests.h"
#include "served.h"

namespace emca::cli {

/// The page in a file, and the data inside it.
inline std::string pageText(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
inline Json pageData(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"emca-data\">";
    const std::size_t from = page.find(begin);
    if (from == std::string::npos) return nullptr;
    return Json::parse(page.substr(from + begin.size(), page.find("</script>", from) - from - begin.size()), nullptr, false);
}

/// A wall behind the fake renderer's paths, whose names are an attack.
inline Mesh hostileWall() {
    Mesh mesh;
    mesh.name = "</script><script>document.body.dataset.attacked = 1</script>\x1b[2J";
    mesh.material = "<img src=x onerror=\"document.body.dataset.attacked = 1\">";
    mesh.positions = {{-6, -6, -1}, {8, -6, -1}, {8, 8, -1}, {-6, 8, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.diffuse = Color(0.7f, 0.3f, 0.2f);
    return mesh;
}

}  // namespace emca::cli
