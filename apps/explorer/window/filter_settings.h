#pragma once

#include "emca/client/session.h"

class QSettings;

namespace emca::explorer {

/// The filter that was left, for the next time.
client::SavedFilter readFilter(const QSettings& settings);
void writeFilter(QSettings& settings, const client::SavedFilter& filter);

}  // namespace emca::explorer
