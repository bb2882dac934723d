#pragma once

#include <filesystem>
#include <string>

#include "emca/core/result.h"

namespace emca::imageio {

/// A library's message as part of a sentence: first line, no full stop.
inline std::string clause(std::string message) {
    message = message.substr(0, message.find('\n'));
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    return message.empty() ? "no reason was given" : message;
}

inline Error unreadable(const std::filesystem::path& file, const std::string& why) {
    return {ErrorCode::fileUnreadable, "The image " + file.string() + " cannot be read: " + why + "."};
}

inline Error unwritable(const std::filesystem::path& file, const std::string& why) {
    return {ErrorCode::fileUnwritable, "The image " + file.string() + " cannot be written: " + why + "."};
}

/// \param done  "read" or "written"
/// \param why   formatModule()'s error
inline Error withoutModule(const std::filesystem::path& file, const char* done, const Error& why) {
    return {why.code, "The image " + file.string() + " cannot be " + done + ": " + why.message + "."};
}

inline Error noMemoryFor(const std::filesystem::path& file) {
    return {ErrorCode::outOfMemory, "The image " + file.string() + " needs more memory than there is."};
}

}  // namespace emca::imageio
