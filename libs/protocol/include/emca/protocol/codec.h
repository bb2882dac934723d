#pragma once

#include "emca/core/result.h"
#include "emca/protocol/frame.h"
#include "emca/protocol/messages.h"

namespace emca::protocol {

/// One memcpy per column. Errors: tooLarge (beyond kMaximumReplyBytes).
Result<Frame> encode(const Message& message);

/// Verifies the whole frame before it is used; paths are checked by PathSet::make. Any bytes are safe to pass.
/// Columns are not copied: they look into the frame and keep it alive.
/// Errors: protocolViolation, saying what was found.
Result<Message> decode(const Frame& frame);

}  // namespace emca::protocol
