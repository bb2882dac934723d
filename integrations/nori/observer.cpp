#include "observer.h"

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace emca::nori_adapter {

namespace {

/// Directions that one computation made, or two that agree but for rounding.
bool same(const nori::Vector3f& a, const nori::Vector3f& b) { return a.dot(b) > (1 - 1e-6f) * a.norm() * b.norm(); }

Lobe lobeOf(const nori::BSDF& bsdf, const nori::BSDFQueryRecord& query) {
    if (query.measure == nori::EDiscrete) return Lobe::specular;
    return bsdf.isDiffuse() ? Lobe::diffuse : Lobe::glossy;
}

const LayerDescription kShadowed{"shadowed tests", LayerKind::mean, "", "Part of the visibility tests from here that found something in between."};

/// Meshes are called by their files, with the folders before.
std::string_view fileName(std::string_view path) { return path.substr(path.find_last_of('/') + 1); }

/// First line of what a Nori object says about itself: its class.
std::string className(const nori::NoriObject& object) {
    const std::string text = object.toString();
    return text.substr(0, text.find_first_of("[\n"));
}

}  // namespace

const std::vector<LayerDescription>& surfaceLayers() {
    static const std::vector<LayerDescription> layers = [] {
        std::vector<LayerDescription> all = pathLayers({PathLayer::intersections, PathLayer::pathDepth});
        all.insert(all.begin() + 1, kShadowed);
        return all;
    }();
    return layers;
}

Observer::Tally::Tally(SurfaceRecorder& surface) : layers(surface), paths(layers), shadowed(surface.find(kShadowed.name)) {}

Observer*& currentObserver() {
    thread_local Observer* observer = nullptr;
    return observer;
}

void Observer::beginPath(PathRecorder emca, std::int64_t sample, SurfaceRecorder* surface) {
    emca_ = emca;
    sample_ = sample;
    part_ = 0;
    begun_ = left_ = false;
    path_.clear();
    waiting_.reset();
    if (surface && !tally_) tally_.emplace(*surface);
    if (tally_) tally_->vertices = 0;
}

void Observer::endPath(const nori::Color3f& radiance) {
    resolveWaiting(true);
    if (tally_) tally_->paths.end(tally_->vertices);
    emca_.setFinalEstimate(toColor(radiance));
}

nori::Point3f Observer::beyond(const nori::Ray3f& ray) const {
    return ray.o + ray.d.normalized() * ((ray.o - centre_).norm() + 2 * radius_);
}

Observer::Vertex Observer::vertexOf(const nori::Ray3f& ray, const nori::Intersection& hit) const {
    Vertex vertex;
    vertex.position = hit.p;
    vertex.frame = hit.shFrame;
    vertex.wi = hit.shFrame.toLocal(-ray.d);
    vertex.mesh = hit.mesh;
    const auto met = std::find_if(hits_.rbegin(), hits_.rend(), [&](const TriangleHit& h) { return h.mesh == hit.mesh && h.t == hit.t; });
    if (met != hits_.rend()) vertex.triangle = *met;
    return vertex;
}

int Observer::startOf(const nori::Ray3f& ray) const {
    for (std::size_t i = path_.size(); i-- > 0;) {
        if (near(path_[i].position, ray.o)) return static_cast<int>(i);
    }
    return -1;
}

bool Observer::isSampled(const Vertex& vertex, const nori::Ray3f& ray) const {
    return vertex.sampled && same(vertex.frame.toWorld(*vertex.sampled), ray.d);
}

void Observer::back() {
    if (!path_.empty()) at(path_.back());
}

/// The path continues behind a vertex. If it did so before, it branches: another part of the same sample.
void Observer::goOnFrom(int start) {
    if (start < 0) return;
    Vertex& vertex = path_[static_cast<std::size_t>(start)];
    path_.resize(static_cast<std::size_t>(start) + 1);
    if (vertex.wentOn) {
        emca_.setPathIndex(sample_, ++part_);
        emca_.setPathOrigin(toVec3f(vertex.position));
        left_ = false;
    }
    vertex.wentOn = true;
}

void Observer::enter(const Vertex& entered) {
    path_.push_back(entered);
    Vertex& vertex = path_.back();
    vertex.depth = path_.size() == 1 ? 1 : path_[path_.size() - 2].depth + 1;
    at(vertex);
    emca_.setIntersectionPos(toVec3f(vertex.position));
    const auto mesh = meshes_.find(vertex.mesh);
    if (mesh != meshes_.end() && vertex.triangle) emca_.setIntersectionSurface(mesh->second, vertex.triangle->face);
    emca_.addIntersectionData("shape", [&] { return fileName(vertex.mesh->getName()); });
    if (vertex.mesh->getBSDF()) emca_.addIntersectionData("material", [&] { return className(*vertex.mesh->getBSDF()); });
    if (vertex.mesh->isEmitter()) {
        emca_.setIntersectionEvent(Event::emission);
        emca_.addIntersectionData("emitter", true);
    }
    if (!tally_) return;
    ++tally_->vertices;
    SurfaceLocation place;
    if (mesh != meshes_.end() && vertex.triangle)
        place = {mesh->second, static_cast<std::int32_t>(vertex.triangle->face), toVec3f(vertex.position), {vertex.triangle->u, vertex.triangle->v}};
    tally_->paths.intersection(place);
    if (tally_->shadowed) vertex.point = tally_->paths.here();
}

void Observer::leave(const nori::Ray3f& ray) {
    emca_.setDepthIndex(path_.empty() ? 1 : path_.back().depth + 1);
    emca_.setIntersectionPosEnvmap([&] { return toVec3f(beyond(ray)); });
    emca_.setIntersectionEvent(Event::background);
    emca_.addPathData("left scene", true);
    left_ = true;
    back();
}

void Observer::resolveWaiting(bool isVertex) {
    if (!waiting_) return;
    const Vertex waiting = *waiting_;
    waiting_.reset();
    if (isVertex) {
        goOnFrom(waitingStart_);
        return enter(waiting);
    }
    const Vertex& from = path_[static_cast<std::size_t>(waitingStart_)];
    at(from);
    emca_.setNextEventEstimationPos(toVec3f(waiting.position), true);
    back();
}

void Observer::test(const nori::Ray3f& ray, int start, bool visible) {
    if (start < 0) return;
    const Vertex& from = path_[static_cast<std::size_t>(start)];
    at(from);
    const nori::Point3f end = std::isfinite(ray.maxt) ? ray(ray.maxt) : beyond(ray);
    emca_.setNextEventEstimationPos(toVec3f(end), visible);
    if (tally_) tally_->shadowed.add(from.point, visible ? 0.f : 1.f);
    back();
}

void Observer::rayTraced(const nori::Ray3f& ray, const nori::Intersection* hit, bool shadowRay) {
    if (!begun_ && !shadowRay) {  // the camera's
        begun_ = true;
        if (hit) enter(vertexOf(ray, *hit));
        else leave(ray);
        return;
    }
    if (waiting_) resolveWaiting(near(waiting_->position, ray.o));
    const int start = startOf(ray);
    const bool sampled = start >= 0 && isSampled(path_[static_cast<std::size_t>(start)], ray);
    if (shadowRay || (std::isfinite(ray.maxt) && !sampled)) return test(ray, start, !hit);
    if (!hit) {
        if (!sampled) return test(ray, start, true);
        goOnFrom(start);
        return leave(ray);
    }
    if (sampled || start < 0) {
        goOnFrom(start);
        return enter(vertexOf(ray, *hit));
    }
    waiting_ = vertexOf(ray, *hit);
    waitingStart_ = start;
}

void Observer::randomNumber(float u) { path_.empty() ? emca_.addPathData("random number", u) : emca_.addIntersectionData("random number", u); }

void Observer::randomNumbers(const nori::Point2f& u) {
    const Vec2f pair{u.x(), u.y()};
    path_.empty() ? emca_.addPathData("random numbers", pair) : emca_.addIntersectionData("random numbers", pair);
}

Observer::Vertex* Observer::vertexOf(const nori::BSDFQueryRecord& query) {
    if (waiting_ && same(waiting_->wi, query.wi)) {
        resolveWaiting(true);
        return &path_.back();
    }
    for (std::size_t i = path_.size(); i-- > 0;) {
        if (same(path_[i].wi, query.wi)) return &path_[i];
    }
    return path_.empty() ? nullptr : &path_.back();
}

void Observer::bsdfSampled(const nori::BSDF& bsdf, const nori::BSDFQueryRecord& query, const nori::Point2f& u, const nori::Color3f& weight) {
    Vertex* vertex = vertexOf(query);
    if (!vertex) return;
    at(*vertex);
    emca_.addIntersectionData("random numbers (direction)", Vec2f{u.x(), u.y()});
    emca_.addIntersectionData("BSDF weight", toColor(weight));
    const std::string label = className(bsdf);
    if (weight.isZero()) {
        emca_.setIntersectionEvent(Event::absorb, Lobe::none, label);
    } else {
        vertex->sampled = query.wo;
        const bool transmitted = nori::Frame::cosTheta(query.wi) * nori::Frame::cosTheta(query.wo) < 0;
        emca_.setIntersectionEvent(transmitted ? Event::transmit : Event::reflect, lobeOf(bsdf, query), label);
        if (transmitted) emca_.addIntersectionData("relative index of refraction", query.eta);
    }
    back();
}

void Observer::bsdfValue(const nori::BSDF&, const nori::BSDFQueryRecord& query, const nori::Color3f& value) {
    Vertex* vertex = vertexOf(query);
    if (!vertex) return;
    at(*vertex);
    if (vertex->sampled && same(*vertex->sampled, query.wo)) emca_.addIntersectionData("BSDF value", toColor(value));
    else emca_.addIntersectionData("BSDF value (light)", toColor(value));
    back();
}

void Observer::bsdfPdf(const nori::BSDF&, const nori::BSDFQueryRecord& query, float pdf) {
    Vertex* vertex = vertexOf(query);
    if (!vertex) return;
    at(*vertex);
    if (vertex->sampled && same(*vertex->sampled, query.wo)) emca_.addIntersectionData("BSDF pdf", pdf);
    else emca_.addIntersectionData("BSDF pdf (light)", pdf);
    back();
}

}  // namespace emca::nori_adapter
