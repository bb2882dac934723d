#include "glyph_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace emca::explorer {

std::vector<Edge> cameraGlyph(const Camera& camera, double imageAspect, float size) {
    const Vec3f d = normalize(camera.direction), up = normalize(camera.up), r = normalize(cross(d, up));
    if (!isFinite(camera.position) || !isFinite(d) || !isFinite(r)) return {};
    std::vector<Edge> edges;
    if (camera.kind == CameraKind::spherical) {
        constexpr int kSteps = 32;
        const Vec3f axes[3][2] = {{r, up}, {up, d}, {d, r}};
        for (const auto& axis : axes)
            for (int i = 0; i < kSteps; ++i) {
                const auto at = [&](int step) {
                    const float a = 2 * std::numbers::pi_v<float> * float(step) / kSteps;
                    return camera.position + (axis[0] * std::cos(a) + axis[1] * std::sin(a)) * (0.4f * size);
                };
                edges.push_back({at(i), at(i + 1)});
            }
        return edges;
    }
    const bool pyramid = camera.kind == CameraKind::perspective;
    const float tangent = pyramid ? std::tan(camera.verticalFieldOfView * std::numbers::pi_v<float> / 360) : 0.4f;
    const float h = size * std::min(tangent, 2.f), w = h * float(imageAspect > 0 ? imageAspect : 1);
    const Vec3f centre = camera.position + d * size;
    const Vec3f corners[4] = {centre - r * w - up * h, centre + r * w - up * h, centre + r * w + up * h, centre - r * w + up * h};
    for (int i = 0; i < 4; ++i) {
        edges.push_back({corners[i], corners[(i + 1) % 4]});
        edges.push_back({pyramid ? camera.position : corners[i] - d * size, corners[i]});
    }
    const Vec3f left = centre + up * (1.15f * h) - r * (0.35f * w), right = centre + up * (1.15f * h) + r * (0.35f * w),
                tip = centre + up * (1.6f * h);
    for (const Edge& e : {Edge{left, right}, Edge{right, tip}, Edge{tip, left}}) edges.push_back(e);
    return edges;
}

namespace {

struct Shine {
    double area = 0;
    Vec3d centre, normal;   ///< area-weighted means; the normal is shorter than 1 where the surface bends
};

Shine shineOf(const Mesh& light) {
    Shine s;
    for (const Triangle& t : light.triangles) {
        const std::size_t n = light.positions.size();
        if (t[0] >= n || t[1] >= n || t[2] >= n) continue;
        const Vec3f a = light.positions[t[0]], b = light.positions[t[1]], c = light.positions[t[2]];
        const Vec3f up = cross(b - a, c - a);
        if (!isFinite(up) || !isFinite(a)) continue;
        const double area = double(length(up)) / 2;
        const Vec3f middle = (a + b + c) / 3.f;
        s.area += area;
        s.centre += Vec3d{middle.x, middle.y, middle.z} * area;
        s.normal += Vec3d{up.x, up.y, up.z} * 0.5;
    }
    if (s.area > 0) {
        s.centre = s.centre / s.area;
        s.normal = s.normal / s.area;
    }
    return s;
}

Vec3f narrow(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }

}  // namespace

std::vector<Edge> lightGlyph(const Mesh& light, float size) {
    if (!light.isEmitter()) return {};
    const Shine s = shineOf(light);
    if (!(s.area > 0)) return {};
    const double reach = std::min(double(size), std::sqrt(s.area));
    std::vector<Edge> edges;
    if (length(s.normal) > 0.7) {
        const Vec3d up = normalize(s.normal), aside = std::abs(up.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        const Vec3d right = normalize(cross(up, aside)), forward = cross(right, up);
        for (const auto& [x, y] : {std::pair(0., 0.), std::pair(1., 1.), std::pair(1., -1.), std::pair(-1., 1.), std::pair(-1., -1.)}) {
            const Vec3d from = s.centre + (right * x + forward * y) * (0.22 * reach);
            edges.push_back({narrow(from), narrow(from + (up + (right * x + forward * y) * 0.25) * reach)});
        }
        return edges;
    }
    const double radius = std::sqrt(s.area / (4 * std::numbers::pi));
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            Vec3d d;
            d[static_cast<std::size_t>(axis)] = sign;
            edges.push_back({narrow(s.centre + d * (1.15 * radius)), narrow(s.centre + d * (1.15 * radius + 0.8 * reach))});
        }
    return edges;
}

GlyphLayer::GlyphLayer(vtkRenderer& strokes) : lines_(strokes), lights_(strokes) {}

void GlyphLayer::setLights(std::span<const Mesh> meshes, float size) {
    std::vector<std::pair<double, const Mesh*>> lights;
    for (const Mesh& mesh : meshes)
        if (mesh.isEmitter()) lights.emplace_back(-shineOf(mesh).area, &mesh);
    std::ranges::stable_sort(lights, {}, &std::pair<double, const Mesh*>::first);
    if (lights.size() > kMaximumLightGlyphs) lights.resize(kMaximumLightGlyphs);
    lightEdges_.clear();
    for (const auto& [area, mesh] : lights)
        for (const Edge& e : lightGlyph(*mesh, std::isfinite(size) && size > 0 ? size : 0.2f)) lightEdges_.push_back(e);
    rebuild();
}

void GlyphLayer::setCamera(const std::optional<Camera>& camera, double imageAspect, float size) {
    camera_ = camera;
    imageAspect_ = imageAspect;
    size_ = std::isfinite(size) && size > 0 ? size : 0.2f;
    rebuild();
}

void GlyphLayer::apply(bool camera, bool lights, const ThemeColors& colors) {
    visible_ = camera;
    lightsVisible_ = lights;
    lights_.setVisible(lights);
    if (color_ == colors.mutedText && halo_ == colors.halo && lightColor_ == colors.emitter) return;
    color_ = colors.mutedText;   // not one of the colours that mean something
    halo_ = colors.halo;
    lightColor_ = colors.emitter;
    rebuild();
}

void GlyphLayer::rebuild() {
    std::vector<Stroke> strokes;
    if (camera_)
        for (const Edge& e : cameraGlyph(*camera_, imageAspect_, size_))
            strokes.push_back({e.from, e.to, 1.6f, StrokeStyle::line, color_});
    lines_.setStrokes(strokes);
    std::vector<Stroke> rays;
    for (const Edge& e : lightEdges_) {
        rays.push_back({e.from, e.to, 1.6f, StrokeStyle::line, lightColor_});
        rays.push_back({e.from, e.to, 6.5f, StrokeStyle::head, lightColor_});
    }
    lights_.setStrokes(rays);
    for (StrokeLayer* layer : {&lines_, &lights_}) {
        layer->look().halo = 1;
        layer->look().haloColor = halo_;
        layer->look().haloColor.setAlphaF(0.6);
    }
}

void GlyphLayer::prepareFrame(const ViewPose& pose, float pixelScale) {
    lines_.look().pixelScale = lights_.look().pixelScale = pixelScale;
    bool outside = false;
    if (camera_) {
        const Vec3d p{camera_->position.x, camera_->position.y, camera_->position.z};
        outside = length(p - pose.position) > 1.5 * double(size_);
    }
    lines_.setVisible(visible_ && outside);
}

}  // namespace emca::explorer
