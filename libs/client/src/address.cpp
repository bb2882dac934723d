#include <charconv>

#include "emca/client/connection.h"

namespace emca::client {

namespace {

Error unreadable(const std::string& text) {
    return {ErrorCode::invalidArgument,
            "\"" + text + "\" is no address: write HOST:PORT, [IPV6]:PORT, HOST or PORT, with a port from 1 to 65535."};
}

bool parsePort(std::string_view text, std::uint16_t& port) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value == 0 || value > 65535) return false;
    port = static_cast<std::uint16_t>(value);
    return true;
}

/// Digits, colons, dots, and the name of an interface after '%'.
bool looksLikeV6(std::string_view text) {
    return text.substr(0, text.find('%')).find_first_not_of("0123456789abcdefABCDEF:.") == text.npos &&
           text.find_first_of(" \t\r\n/[]") == text.npos;
}

bool isNumber(std::string_view text) { return !text.empty() && text.find_first_not_of("0123456789") == text.npos; }

}  // namespace

Result<Address> Address::parse(const std::string& text) {
    Address address;
    std::string_view rest = text;
    if (isNumber(rest)) {
        if (!parsePort(rest, address.port)) return unreadable(text);
        return address;
    }
    if (rest.starts_with('[')) {
        const auto end = rest.find(']');
        if (end == rest.npos || end == 1) return unreadable(text);
        address.host = rest.substr(1, end - 1);
        if (!looksLikeV6(address.host)) return unreadable(text);
        rest.remove_prefix(end + 1);
        if (!rest.empty() && (rest[0] != ':' || !parsePort(rest.substr(1), address.port))) return unreadable(text);
        return address;
    }
    const auto colon = rest.find(':');
    if (colon != rest.npos && rest.find(':', colon + 1) != rest.npos) {  // an IPv6 address without a port
        if (!looksLikeV6(text)) return unreadable(text);
        address.host = text;
        return address;
    }
    address.host = rest.substr(0, colon);
    if (colon != rest.npos && !parsePort(rest.substr(colon + 1), address.port)) return unreadable(text);
    if (address.host.empty() || address.host.find_first_of(" \t\r\n/[]") != address.host.npos) return unreadable(text);
    return address;
}

std::string Address::text() const {
    const bool v6 = host.find(':') != std::string::npos;
    return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace emca::client
