// Images by the installed library: EXR needs nothing else, PNG needs the module that was installed with it.
#include <cstdio>

#include "emca/imageio/imageio.h"

int main() {
    for (const char* file : {"consumer.exr", "consumer.png"}) {
        if (const auto written = emca::imageio::write(file, emca::Image(5, 4)); !written)
            return std::puts(written.error().message.c_str()), 1;
        const auto image = emca::imageio::read(file);
        if (!image) return std::puts(image.error().message.c_str()), 1;
        if (image->width() != 5 || image->height() != 4) return std::puts("another size"), 1;
    }
    return 0;
}
