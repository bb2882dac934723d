#include "wire.h"

#include <utility>

namespace emca::bridge {

namespace {

constexpr std::size_t kBufferBytes = std::size_t(1) << 18;

std::string notThisProtocol(const std::string& found) {
    return found + ": the server speaks another version than the published one (2021), or its reply went wrong.";
}

}  // namespace

void WireReader::fail(ErrorCode code, std::string sentence) {
    if (failed_) return;  // what follows a failure is its consequence
    failed_ = true;
    error_ = {code, std::move(sentence)};
}

void WireReader::explain(const std::string& where) {
    if (failed_) error_.message.insert(error_.message.ends_with('.') ? error_.message.size() - 1 : error_.message.size(), where);
}

bool WireReader::fill() {
    if (!ok()) return false;
    if (buffer_.empty()) buffer_.resize(kBufferBytes);
    if (begin_ > 0) {
        std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
        end_ -= begin_;
        begin_ = 0;
    }
    const auto came = source_.readSome(std::span(buffer_).subspan(end_), silence_);
    if (!came) {
        fail(came.error().code, came.error().message);
        return false;
    }
    end_ += *came;
    return true;
}

void WireReader::bytes(std::span<std::byte> into, std::size_t unit) {
    replyBytes_ += into.size();
    if (replyBytes_ > limits_.replyBytes) {
        fail(ErrorCode::tooLarge, "The server's reply exceeds " + std::to_string(limits_.replyBytes) + " bytes: ask for fewer samples per pixel.");
    }
    for (std::size_t done = 0; done < into.size();) {
        if (!ok()) return;
        if (drained() && !fill()) return;
        const std::size_t part = std::min(into.size() - done, end_ - begin_);
        std::memcpy(into.data() + done, buffer_.data() + begin_, part);
        begin_ += part;
        done += part;
    }
    if (!swapped_) return;
    for (std::size_t i = 0; i < into.size(); i += unit) std::reverse(into.begin() + static_cast<std::ptrdiff_t>(i), into.begin() + static_cast<std::ptrdiff_t>(i + unit));
}

bool WireReader::nextIs(std::span<const std::byte> expected) {
    for (std::size_t agreed = 0; ok();) {
        const std::size_t here = std::min(end_ - begin_, expected.size());
        if (here > agreed && std::memcmp(buffer_.data() + begin_ + agreed, expected.data() + agreed, here - agreed) != 0) return false;
        agreed = here;
        if (agreed == expected.size()) return true;
        fill();
    }
    return false;
}

bool WireReader::boolean(const char* what) {
    const auto value = number<std::uint8_t>();
    if (ok() && value > 1) {
        fail(ErrorCode::protocolViolation, notThisProtocol("Whether there is " + std::string(what) + " is said by a byte of " + std::to_string(value) + " instead of 0 or 1"));
    }
    return ok() && value == 1;
}

std::uint32_t WireReader::count(std::uint32_t limit, const char* what) {
    const auto value = number<std::uint32_t>();
    if (ok() && value > limit) {
        fail(ErrorCode::protocolViolation, notThisProtocol("The server announces " + std::to_string(value) + " " + what + ", more than " + std::to_string(limit)));
    }
    return ok() ? value : 0;
}

std::string WireReader::text(std::uint32_t limit, const char* what) {
    const auto size = number<std::uint64_t>();
    if (ok() && size > limit) {
        fail(ErrorCode::protocolViolation, notThisProtocol("The server announces " + std::to_string(size) + " bytes for " + what + ", more than " + std::to_string(limit)));
    }
    std::string value;
    constexpr std::size_t kStep = std::size_t(1) << 16;
    while (ok() && value.size() < size) {
        const std::size_t first = value.size();
        value.resize(std::min<std::size_t>(size, first + kStep));
        bytes(std::as_writable_bytes(std::span(value).subspan(first)), 1);
    }
    return ok() ? value : std::string();
}

Vec3f WireReader::vector() {
    const float x = real(), y = real(), z = real();
    return {x, y, z};
}

ColorA WireReader::color() {
    const float r = real(), g = real(), b = real(), a = real();
    return {r, g, b, a};
}

}  // namespace emca::bridge
