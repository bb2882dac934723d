#include "loaded_scene.h"

#include <cmath>
#include <filesystem/resolver.h>
#include <iostream>
#include <nori/parser.h>

namespace emca::nori_adapter {

namespace {

constexpr float kPi = 3.14159265358979f;

/// Nori reports to the standard output, where this program's own line is waited for.
class ToStandardError {
  public:
    ToStandardError() : before_(std::cout.rdbuf(std::cerr.rdbuf())) {}
    ~ToStandardError() { std::cout.rdbuf(before_); }
    ToStandardError(const ToStandardError&) = delete;
    ToStandardError& operator=(const ToStandardError&) = delete;

  private:
    std::streambuf* before_;
};

std::string className(const nori::NoriObject& object) {
    const std::string text = object.toString();
    return text.substr(0, text.find_first_of("[\n"));
}

/// Rough colour of a surface: its albedo, if it were diffuse.
Color colorOf(const nori::BSDF* bsdf) {
    if (!bsdf) return Color(0.5f);
    const nori::Vector3f up(0.f, 0.f, 1.f);
    const Color c = toColor(bsdf->eval(nori::BSDFQueryRecord(up, up, nori::ESolidAngle))) * kPi;
    if (!isFinite(c) || isBlack(c)) return Color(0.5f);
    return {std::min(c.r, 1.f), std::min(c.g, 1.f), std::min(c.b, 1.f)};
}

}  // namespace

LoadedScene::LoadedScene(std::string name, std::unique_ptr<nori::Scene> scene)
    : name_(std::move(name)), integratorName_(className(*scene->getIntegrator())), scene_(std::move(scene)),
      filter_(*scene_->getCamera()->getReconstructionFilter()) {
    for (std::size_t i = 0; i < scene_->getMeshes().size(); ++i) {
        const nori::Mesh* mesh = scene_->getMeshes()[i];
        meshIndices_[mesh] = static_cast<std::int32_t>(i);
        if (mesh->getBSDF()) observe(*mesh->getBSDF());
    }
    const nori::BoundingBox3f& box = scene_->getBoundingBox();
    centre_ = box.getCenter();
    radius_ = std::max(1e-6f, (box.max - box.min).norm() / 2);
}

Result<std::unique_ptr<LoadedScene>> LoadedScene::load(const std::filesystem::path& file) {
    std::error_code ignored;
    const std::filesystem::path absolute = std::filesystem::absolute(file, ignored);
    if (!std::filesystem::is_regular_file(absolute, ignored)) return Error{ErrorCode::fileNotFound, "There is no scene file " + file.string() + "."};
    const ToStandardError reports;
    try {
        nori::getFileResolver()->prepend(::filesystem::path(absolute.parent_path().string()));
        std::unique_ptr<nori::NoriObject> root(nori::loadFromXML(absolute.string()));
        if (root->getClassType() != nori::NoriObject::EScene) {
            return Error{ErrorCode::fileUnreadable, file.string() + " is a " + nori::NoriObject::classTypeName(root->getClassType()) + ": give a scene."};
        }
        std::unique_ptr<nori::Scene> scene(static_cast<nori::Scene*>(root.release()));
        scene->getIntegrator()->preprocess(scene.get());
        return std::unique_ptr<LoadedScene>(new LoadedScene(file.stem().string(), std::move(scene)));
    } catch (const std::exception& e) {
        return Error{ErrorCode::fileUnreadable, "Nori could not read " + file.string() + ": " + e.what() + "."};
    }
}

Camera LoadedScene::camera() const {
    const nori::Camera& theirs = *scene_->getCamera();
    const auto width = static_cast<float>(theirs.getOutputSize().x()), height = static_cast<float>(theirs.getOutputSize().y());
    const auto through = [&](float x, float y) {
        nori::Ray3f ray;
        theirs.sampleRay(ray, nori::Point2f(x, y), nori::Point2f(0.5f, 0.5f));
        return ray;
    };
    const nori::Ray3f middle = through(width / 2, height / 2), top = through(width / 2, 0), bottom = through(width / 2, height),
                      right = through(width, height / 2);
    const Vec3f direction = normalize(toVec3f(middle.d)), up = toVec3f(top.d) - toVec3f(bottom.d);
    Camera camera;
    camera.position = toVec3f(middle.o);
    camera.direction = direction;
    camera.up = normalize(up - direction * dot(up, direction));
    camera.rightHanded = dot(cross(camera.direction, camera.up), toVec3f(right.d)) > 0;
    camera.verticalFieldOfView = std::acos(std::clamp(dot(normalize(toVec3f(top.d)), normalize(toVec3f(bottom.d))), -1.f, 1.f)) * 180.f / kPi;
    camera.nearClip = radius_ * 1e-4f;
    camera.farClip = radius_ * 100.f;
    return camera;
}

std::vector<Mesh> LoadedScene::meshes() const {
    std::vector<Mesh> meshes;
    for (const nori::Mesh* theirs : scene_->getMeshes()) {
        Mesh mesh;
        mesh.name = std::filesystem::path(theirs->getName()).filename().string();
        if (theirs->getBSDF()) mesh.material = className(*theirs->getBSDF());
        mesh.diffuse = colorOf(theirs->getBSDF());
        if (theirs->isEmitter()) mesh.emission = Color(1.f);  // how much, Nori's interface does not say
        const nori::MatrixXf& positions = theirs->getVertexPositions();
        for (Eigen::Index i = 0; i < positions.cols(); ++i) mesh.positions.push_back({positions(0, i), positions(1, i), positions(2, i)});
        const nori::MatrixXu& faces = theirs->getIndices();
        for (Eigen::Index i = 0; i < faces.cols(); ++i) mesh.triangles.push_back({faces(0, i), faces(1, i), faces(2, i)});
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

}  // namespace emca::nori_adapter
