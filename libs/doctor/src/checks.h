#pragma once

#include "patient.h"

// One function per check, in the order in which they run.
namespace emca::doctor {

Finding checkHandshake(Patient& patient);
Finding checkInfo(Patient& patient);
Finding checkScene(Patient& patient);       ///< "meshes"
Finding checkView(Patient& patient);        ///< "camera"
Finding checkRenderedImage(Patient& patient);
Finding checkReplay(Patient& patient);
Finding checkSums(Patient& patient);
Finding checkPaths(Patient& patient);
Finding checkValues(Patient& patient);
Finding checkSurfaces(Patient& patient);
Finding checkCameraRays(Patient& patient);
Finding checkPixelList(Patient& patient);
Finding checkSamples(Patient& patient);
Finding checkConcurrent(Patient& patient);
Finding checkOverhead(Patient& patient);
Finding checkLayers(Patient& patient);
Finding checkLightProbe(Patient& patient);
Finding checkBadRequests(Patient& patient);
Finding checkCancel(Patient& patient);

}  // namespace emca::doctor
