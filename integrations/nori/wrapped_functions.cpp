// How the observer comes to know: what the linker puts in place of two of Nori's functions (--wrap), and what observe() puts
// into the tables of virtual functions of BSDFs. Each calls the real function and tells the observer of this thread, if
// there is one.
#include <cstring>
#include <unordered_map>

#include <sys/mman.h>
#include <unistd.h>

#include "emca/adapter/exchanged.h"
#include "nori_headers.h"
#include "observed_names.h"
#include "observer.h"

using emca::nori_adapter::currentObserver;
using emca::nori_adapter::Observer;

// Member functions as the linker sees them: `this` is the first parameter.

bool realAccelIntersect(const nori::Accel* self, const nori::Ray3f& ray, nori::Intersection& its, bool shadowRay) __asm__("__real_" EMCA_NAME_accel_intersect);
__attribute__((used)) bool wrapAccelIntersect(const nori::Accel* self, const nori::Ray3f& ray, nori::Intersection& its, bool shadowRay)
    __asm__("__wrap_" EMCA_NAME_accel_intersect);
bool realMeshIntersect(const nori::Mesh* self, uint32_t face, const nori::Ray3f& ray, float& u, float& v, float& t) __asm__("__real_" EMCA_NAME_mesh_intersect);
__attribute__((used)) bool wrapMeshIntersect(const nori::Mesh* self, uint32_t face, const nori::Ray3f& ray, float& u, float& v, float& t)
    __asm__("__wrap_" EMCA_NAME_mesh_intersect);

bool wrapAccelIntersect(const nori::Accel* self, const nori::Ray3f& ray, nori::Intersection& its, bool shadowRay) {
    Observer* observer = currentObserver();
    if (!observer) return realAccelIntersect(self, ray, its, shadowRay);
    const nori::Ray3f asked = ray;  // the integrator may use one variable for both
    observer->beginRay();
    const bool hit = realAccelIntersect(self, ray, its, shadowRay);
    observer->rayTraced(asked, hit ? &its : nullptr, shadowRay);
    return hit;
}

bool wrapMeshIntersect(const nori::Mesh* self, uint32_t face, const nori::Ray3f& ray, float& u, float& v, float& t) {
    const bool hit = realMeshIntersect(self, face, ray, u, v, t);
    if (hit) {
        if (Observer* observer = currentObserver()) observer->triangleHit({self, face, u, v, t});
    }
    return hit;
}

namespace emca::nori_adapter {

namespace {

using Sample = nori::Color3f (*)(const nori::BSDF*, nori::BSDFQueryRecord&, const nori::Point2f&);
using Eval = nori::Color3f (*)(const nori::BSDF*, const nori::BSDFQueryRecord&);
using Pdf = float (*)(const nori::BSDF*, const nori::BSDFQueryRecord&);

/// The functions that a class of BSDFs has itself.
struct Functions {
    Sample sample;
    Eval eval;
    Pdf pdf;
};
/// By table. Only grows; while anything renders, it is only read.
std::unordered_map<const void*, Functions>& functions() {
    static std::unordered_map<const void*, Functions> all;
    return all;
}

void** tableOf(const nori::BSDF& bsdf) {
    void** table = nullptr;
    std::memcpy(&table, static_cast<const void*>(&bsdf), sizeof table);
    return table;
}

const Functions& functionsOf(const nori::BSDF* bsdf) { return functions().find(tableOf(*bsdf))->second; }

nori::Color3f observedSample(const nori::BSDF* self, nori::BSDFQueryRecord& query, const nori::Point2f& u) {
    const nori::Point2f random = u;
    const nori::Color3f weight = [&] {
        const adapter::Exchanged unobserved(currentObserver(), nullptr);  // what it calls inside is not the integrator's
        return functionsOf(self).sample(self, query, u);
    }();
    if (Observer* observer = currentObserver()) observer->bsdfSampled(*self, query, random, weight);
    return weight;
}

nori::Color3f observedEval(const nori::BSDF* self, const nori::BSDFQueryRecord& query) {
    const nori::Color3f value = [&] {
        const adapter::Exchanged unobserved(currentObserver(), nullptr);  // what it calls inside is not the integrator's
        return functionsOf(self).eval(self, query);
    }();
    if (Observer* observer = currentObserver()) observer->bsdfValue(*self, query, value);
    return value;
}

float observedPdf(const nori::BSDF* self, const nori::BSDFQueryRecord& query) {
    const float pdf = [&] {
        const adapter::Exchanged unobserved(currentObserver(), nullptr);  // what it calls inside is not the integrator's
        return functionsOf(self).pdf(self, query);
    }();
    if (Observer* observer = currentObserver()) observer->bsdfPdf(*self, query, pdf);
    return pdf;
}

/// Place of a virtual function in its table. Source: Itanium C++ ABI, section 2.3: a pointer to a virtual member function is
/// its offset in bytes, plus 1.
template <typename Function>
std::size_t slotOf(Function function) {
    std::ptrdiff_t offset = 0;
    std::memcpy(&offset, &function, sizeof offset);
    return static_cast<std::size_t>(offset - 1) / sizeof(void*);
}

/// Exchanges an entry of a table, which lies in memory that is only to be read.
template <typename Function>
Function exchange(void** entry, Function function) {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    void* const start = reinterpret_cast<void*>(reinterpret_cast<std::uintptr_t>(entry) & ~(page - 1));
    const Function before = reinterpret_cast<Function>(*entry);
    if (mprotect(start, page, PROT_READ | PROT_WRITE) != 0) return before;
    *entry = reinterpret_cast<void*>(function);
    mprotect(start, page, PROT_READ);
    return before;
}

}  // namespace

void observe(const nori::BSDF& bsdf) {
    void** const table = tableOf(bsdf);
    if (functions().contains(table)) return;
    void** const sample = table + slotOf(&nori::BSDF::sample);
    void** const eval = table + slotOf(&nori::BSDF::eval);
    void** const pdf = table + slotOf(&nori::BSDF::pdf);
    Functions own{reinterpret_cast<Sample>(*sample), reinterpret_cast<Eval>(*eval), reinterpret_cast<Pdf>(*pdf)};
    functions().emplace(table, own);
    exchange(sample, &observedSample);
    exchange(eval, &observedEval);
    exchange(pdf, &observedPdf);
}

}  // namespace emca::nori_adapter
