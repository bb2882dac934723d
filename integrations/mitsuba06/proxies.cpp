#include "proxies.h"

#include <utility>

#include "observation.h"
#include "scene_shapes.h"

namespace emca::mitsuba06 {

namespace {

mts::Properties named(std::string_view name) {
    mts::Properties properties;
    properties.setID(std::string(name));
    return properties;
}

class ObservedBsdf final : public mts::BSDF {
  public:
    explicit ObservedBsdf(mts::BSDF& inner) : mts::BSDF(named(nameOf(inner))), inner_(&inner), bsdf_(inner) {
        for (int i = 0; i < inner.getComponentCount(); ++i) m_components.push_back(inner.getType(i));
        m_combinedType = inner.getType();
        m_usesRayDifferentials = inner.usesRayDifferentials();
    }

    mts::Spectrum sample(mts::BSDFSamplingRecord& record, const mts::Point2& u) const override {
        const mts::Spectrum weight = bsdf_.sample(record, u);
        if (Observation* const observer = Observation::current()) observer->bsdfSampled(record, weight, nullptr, bsdf_);
        return weight;
    }
    mts::Spectrum sample(mts::BSDFSamplingRecord& record, mts::Float& pdf, const mts::Point2& u) const override {
        const mts::Spectrum weight = bsdf_.sample(record, pdf, u);
        if (Observation* const observer = Observation::current()) observer->bsdfSampled(record, weight, &pdf, bsdf_);
        return weight;
    }
    mts::Spectrum eval(const mts::BSDFSamplingRecord& record, mts::EMeasure measure) const override {
        const mts::Spectrum value = bsdf_.eval(record, measure);
        // Of a discrete measure: surfaces that let shadow rays pass, which are no vertices.
        if (Observation* const observer = measure == mts::ESolidAngle ? Observation::current() : nullptr)
            observer->bsdfEvaluated(record, value);
        return value;
    }
    mts::Float pdf(const mts::BSDFSamplingRecord& record, mts::EMeasure measure) const override {
        const mts::Float pdf = bsdf_.pdf(record, measure);
        if (Observation* const observer = measure == mts::ESolidAngle ? Observation::current() : nullptr)
            observer->bsdfDensity(record, pdf);
        return pdf;
    }

    mts::Spectrum getDiffuseReflectance(const mts::Intersection& its) const override {
        return bsdf_.getDiffuseReflectance(its);
    }
    mts::Spectrum getSpecularReflectance(const mts::Intersection& its) const override {
        return bsdf_.getSpecularReflectance(its);
    }
    mts::Float getEta() const override { return bsdf_.getEta(); }
    mts::Float getRoughness(const mts::Intersection& its, int component) const override {
        return bsdf_.getRoughness(its, component);
    }
    mts::Frame getFrame(const mts::Intersection& its) const override { return bsdf_.getFrame(its); }
    void getFrameDerivative(const mts::Intersection& its, mts::Frame& du, mts::Frame& dv) const override {
        bsdf_.getFrameDerivative(its, du, dv);
    }
    mts::Shader* createShader(mts::Renderer* renderer) const override { return bsdf_.createShader(renderer); }
    std::string toString() const override { return bsdf_.toString(); }
    const mts::Class* getClass() const override { return bsdf_.getClass(); }

  private:
    mts::ref<mts::BSDF> inner_;
    const mts::BSDF& bsdf_;
};

class ObservedEmitter final : public mts::Emitter {
  public:
    explicit ObservedEmitter(mts::Emitter& inner)
        : mts::Emitter(named(nameOf(static_cast<const mts::ConfigurableObject&>(inner)))),
          inner_(&inner),
          emitter_(inner) {
        m_type = inner.getType();
        m_shape = inner.getShape();
        m_medium = inner.getMedium();
        m_worldTransform = inner.getWorldTransform();
        m_samplingWeight = inner.getSamplingWeight();
    }

    mts::Spectrum eval(const mts::Intersection& its, const mts::Vector& d) const override {
        const mts::Spectrum radiance = emitter_.eval(its, d);
        if (Observation* const observer = Observation::current()) observer->emitted(its, radiance, emitter_);
        return radiance;
    }
    mts::Spectrum sampleDirect(mts::DirectSamplingRecord& record, const mts::Point2& u) const override {
        const mts::Spectrum value = emitter_.sampleDirect(record, u);
        if (Observation* const observer = Observation::current()) observer->lightSampled(record, value, emitter_);
        return value;
    }
    mts::Float pdfDirect(const mts::DirectSamplingRecord& record) const override {
        const mts::Float pdf = emitter_.pdfDirect(record);
        if (Observation* const observer = Observation::current()) observer->lightDensity(record, pdf, emitter_);
        return pdf;
    }

    mts::Spectrum samplePosition(mts::PositionSamplingRecord& record, const mts::Point2& u,
                                 const mts::Point2* extra) const override {
        return emitter_.samplePosition(record, u, extra);
    }
    mts::Spectrum sampleDirection(mts::DirectionSamplingRecord& direction, mts::PositionSamplingRecord& position,
                                  const mts::Point2& u, const mts::Point2* extra) const override {
        return emitter_.sampleDirection(direction, position, u, extra);
    }
    mts::Spectrum evalPosition(const mts::PositionSamplingRecord& record) const override {
        return emitter_.evalPosition(record);
    }
    mts::Spectrum evalDirection(const mts::DirectionSamplingRecord& direction,
                                const mts::PositionSamplingRecord& position) const override {
        return emitter_.evalDirection(direction, position);
    }
    mts::Float pdfPosition(const mts::PositionSamplingRecord& record) const override {
        return emitter_.pdfPosition(record);
    }
    mts::Float pdfDirection(const mts::DirectionSamplingRecord& direction,
                            const mts::PositionSamplingRecord& position) const override {
        return emitter_.pdfDirection(direction, position);
    }
    mts::Spectrum sampleRay(mts::Ray& ray, const mts::Point2& spatial, const mts::Point2& directional,
                            mts::Float time) const override {
        return emitter_.sampleRay(ray, spatial, directional, time);
    }
    mts::ref<mts::Bitmap> getBitmap(const mts::Vector2i& size) const override { return emitter_.getBitmap(size); }
    mts::Spectrum evalEnvironment(const mts::RayDifferential& ray) const override {
        const mts::Spectrum radiance = emitter_.evalEnvironment(ray);
        if (Observation* const observer = Observation::current()) observer->environmentSeen(ray, radiance, emitter_);
        return radiance;
    }
    bool fillDirectSamplingRecord(mts::DirectSamplingRecord& record, const mts::Ray& ray) const override {
        if (!emitter_.fillDirectSamplingRecord(record, ray)) return false;
        record.object = this;  // or densities would be asked of the original
        return true;
    }
    bool isCompound() const override { return emitter_.isCompound(); }
    mts::Emitter* getElement(std::size_t index) override { return inner_->getElement(index); }
    mts::ref<mts::Shape> createShape(const mts::Scene* scene) override { return inner_->createShape(scene); }
    mts::AABB getAABB() const override { return emitter_.getAABB(); }
    mts::Shader* createShader(mts::Renderer* renderer) const override { return emitter_.createShader(renderer); }
    std::string toString() const override { return emitter_.toString(); }
    const mts::Class* getClass() const override { return emitter_.getClass(); }

  private:
    mts::ref<mts::Emitter> inner_;
    const mts::Emitter& emitter_;
};

class ObservedPhase final : public mts::PhaseFunction {
  public:
    explicit ObservedPhase(mts::PhaseFunction& inner)
        : mts::PhaseFunction(named(nameOf(inner))), inner_(&inner), phase_(inner) {
        m_type = inner.getType();
    }

    mts::Float eval(const mts::PhaseFunctionSamplingRecord& record) const override {
        const mts::Float value = phase_.eval(record);
        if (Observation* const observer = Observation::current()) observer->phaseEvaluated(record, value);
        return value;
    }
    mts::Float sample(mts::PhaseFunctionSamplingRecord& record, mts::Sampler* sampler) const override {
        const mts::Float weight = phase_.sample(record, sampler);
        if (Observation* const observer = Observation::current())
            observer->phaseSampled(record, weight, nullptr, phase_);
        return weight;
    }
    mts::Float sample(mts::PhaseFunctionSamplingRecord& record, mts::Float& pdf, mts::Sampler* sampler) const override {
        const mts::Float weight = phase_.sample(record, pdf, sampler);
        if (Observation* const observer = Observation::current()) observer->phaseSampled(record, weight, &pdf, phase_);
        return weight;
    }
    mts::Float pdf(const mts::PhaseFunctionSamplingRecord& record) const override { return phase_.pdf(record); }
    bool needsDirectionallyVaryingCoefficients() const override {
        return phase_.needsDirectionallyVaryingCoefficients();
    }
    mts::Float sigmaDir(mts::Float cosTheta) const override { return phase_.sigmaDir(cosTheta); }
    mts::Float sigmaDirMax() const override { return phase_.sigmaDirMax(); }
    mts::Float getMeanCosine() const override { return phase_.getMeanCosine(); }
    std::string toString() const override { return phase_.toString(); }
    const mts::Class* getClass() const override { return phase_.getClass(); }

  private:
    mts::ref<mts::PhaseFunction> inner_;
    const mts::PhaseFunction& phase_;
};

/// Members that Mitsuba keeps for derived classes; as pointers to members they can be read of any object.
struct MediumMembers : mts::Medium {
    static constexpr auto phaseFunction() { return &MediumMembers::m_phaseFunction; }
};

struct SamplerMembers : mts::Sampler {
    static constexpr auto sizes1D() { return &SamplerMembers::m_req1D; }
    static constexpr auto sizes2D() { return &SamplerMembers::m_req2D; }
    static constexpr auto arrays1D() { return &SamplerMembers::m_sampleArrays1D; }
    static constexpr auto arrays2D() { return &SamplerMembers::m_sampleArrays2D; }
};

/// Private members, by the rule that explicit instantiations may name them ([temp.spec.general]): Mitsuba lets nobody
/// exchange the environment.
template <auto Member>
struct EnvironmentAccess {
    friend mts::ref<mts::Emitter>& environmentOf(mts::Scene& scene) { return scene.*Member; }
};
template struct EnvironmentAccess<&mts::Scene::m_environmentEmitter>;
mts::ref<mts::Emitter>& environmentOf(mts::Scene& scene);

class ObservedSampler final : public mts::Sampler {
  public:
    explicit ObservedSampler(mts::Sampler& inner) : mts::Sampler(inner.getProperties()), inner_(inner) {
        m_req1D = inner.*SamplerMembers::sizes1D();
        m_req2D = inner.*SamplerMembers::sizes2D();
        m_sampleArrays1D = inner.*SamplerMembers::arrays1D();
        m_sampleArrays2D = inner.*SamplerMembers::arrays2D();
        m_dimension1DArray = m_dimension2DArray = 0;
        m_sampleCount = inner.getSampleCount();
        m_sampleIndex = inner.getSampleIndex();
    }
    ~ObservedSampler() override {
        m_sampleArrays1D.clear();  // the other sampler's
        m_sampleArrays2D.clear();
    }

    mts::Float next1D() override {
        const mts::Float u = inner_.next1D();
        if (Observation* const observer = Observation::current()) observer->randomNumber(u);
        return u;
    }
    mts::Point2 next2D() override {
        const mts::Point2 u = inner_.next2D();
        if (Observation* const observer = Observation::current()) observer->randomNumbers(u);
        return u;
    }
    mts::ref<mts::Sampler> clone() override { return inner_.clone(); }
    std::string toString() const override { return inner_.toString(); }

  private:
    mts::Sampler& inner_;
};

}  // namespace

ObservedScene::ObservedScene(mts::Scene& scene)
    : scene_(scene), emitterList_(scene.getEmitters()), environment_(environmentOf(scene)) {
    for (auto& emitter : scene.getEmitters()) {
        mts::ref<mts::Emitter>& proxy = emitters_[emitter.get()];
        if (proxy == nullptr) proxy = new ObservedEmitter(*emitter);
        emitter = proxy;
    }
    if (environment_ != nullptr) {
        mts::ref<mts::Emitter>& proxy = emitters_[environment_.get()];
        if (proxy == nullptr) proxy = new ObservedEmitter(*environment_);
        environmentOf(scene) = proxy;
    }
    for (auto& shape : scene.getShapes()) {
        observe(*shape);
        for (mts::Shape* const inner : shapesOfInstance(*shape)) observe(*inner);
    }
    for (auto& medium : scene.getMedia()) {
        mts::ref<mts::PhaseFunction>& phase = (*medium).*MediumMembers::phaseFunction();
        if (phase == nullptr) continue;
        phases_.emplace_back(medium.get(), phase);
        phase = new ObservedPhase(*phase);
    }
}

void ObservedScene::observe(mts::Shape& shape) {
    for (const ShapeBefore& before : shapes_)
        if (before.shape == &shape) return;
    shapes_.push_back({&shape, shape.getBSDF(), shape.getEmitter()});
    if (shape.hasBSDF()) {
        mts::ref<mts::BSDF>& proxy = bsdfs_[shape.getBSDF()];
        if (proxy == nullptr) proxy = new ObservedBsdf(*shape.getBSDF());
        shape.setBSDF(proxy);
    }
    if (shape.isEmitter()) {
        mts::ref<mts::Emitter>& proxy = emitters_[shape.getEmitter()];
        if (proxy == nullptr) proxy = new ObservedEmitter(*shape.getEmitter());
        shape.setEmitter(proxy);
    }
}

ObservedScene::~ObservedScene() {
    for (ShapeBefore& before : shapes_) {
        before.shape->setBSDF(before.bsdf);
        before.shape->setEmitter(before.emitter);
    }
    scene_.getEmitters() = emitterList_;
    environmentOf(scene_) = environment_;
    for (auto& [medium, phase] : phases_) (*medium).*MediumMembers::phaseFunction() = phase;
}

mts::ref<mts::Sampler> observed(mts::Sampler& sampler) { return new ObservedSampler(sampler); }

}  // namespace emca::mitsuba06
