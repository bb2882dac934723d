// Writes one payload of every kind of message into a folder: what fuzz_frame begins with.
#include <cstdio>
#include <fstream>
#include <string>

#include "emca/protocol/codec.h"
#include "sample_messages.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: write_corpus FOLDER\n", stderr);
        return 2;
    }
    for (const auto& message : emca::protocol::test::everyMessage()) {
        const auto frame = emca::protocol::encode(message);
        if (!frame) return 1;
        std::ofstream file(std::string(argv[1]) + "/frame-" + std::to_string(message.body.index()), std::ios::binary);
        file.write(reinterpret_cast<const char*>(frame->data()), static_cast<std::streamsize>(frame->size()));
        if (!file) return 1;
    }
    return 0;
}
