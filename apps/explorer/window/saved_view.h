#pragma once

#include "emca/client/session.h"

namespace emca::explorer {

struct Views;

/// How the window looks at what it holds, for a session: which image is the reference, what of both is shown, and what the
/// 3D view draws. \param dataset  the reference is an index into its images
client::SavedView savedView(const Views& views, const client::Dataset& dataset);
/// Looks at a session that was just opened as its maker did. What this version does not know is left out.
void show(const client::SavedView& saved, Views& views, const client::Dataset& dataset);

}  // namespace emca::explorer
