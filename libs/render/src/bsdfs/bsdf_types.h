#pragma once

#include <memory>

#include "emca/render/bsdf_factory.h"
#include "emca/render/property_reader.h"

namespace emca::render {

/// Makers of the materials, one per file of this folder; parameters, their defaults and names are those of Mitsuba 0.6.
/// Each reads its parameters; makeBsdf() sets the name and reports what was left unread.

std::shared_ptr<Bsdf> makeDiffuse(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeDielectric(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeThinDielectric(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeRoughDielectric(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeConductor(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeRoughConductor(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makePlastic(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeRoughPlastic(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeTwoSided(PropertyReader& read, FactoryContext& context);
std::shared_ptr<Bsdf> makeMask(PropertyReader& read, FactoryContext& context);

/// The same material on both sides without a detour at each call, if `front` is a diffuse one; null otherwise.
std::shared_ptr<Bsdf> makeTwoSidedDiffuse(const Bsdf& front);

/// Diffuse without a scene file.
std::shared_ptr<Bsdf> makeDiffuse(Color reflectance);

}  // namespace emca::render
