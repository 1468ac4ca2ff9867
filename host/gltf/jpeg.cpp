// libjpeg leaves its functions by longjmp: what has a destructor stays out of those that it may leave.
#include "gltf/decode.h"

#include <csetjmp>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#if CLVNDF_JPEG
#include <jpeglib.h>
#endif

namespace vndf::gltf {

#if CLVNDF_JPEG

namespace {

// Of a progressive file: each takes as long as an image.
constexpr int most_scans = 64;

struct Reader {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf way_out;
    char wrong[JMSG_LENGTH_MAX] = "";
    std::vector<unsigned char> row;

    ~Reader() { jpeg_destroy_decompress(&jpeg); }
};

Reader& reader_of(j_common_ptr jpeg) {
    return *static_cast<Reader*>(jpeg->client_data);
}

[[noreturn]] void note_error(j_common_ptr jpeg) {
    Reader& reader = reader_of(jpeg);
    jpeg->err->format_message(jpeg, reader.wrong);
    std::longjmp(reader.way_out, 1);
}

void ignore_message(j_common_ptr) {}

void bound_scans(j_common_ptr jpeg) {
    Reader& reader = reader_of(jpeg);
    if (reader.jpeg.input_scan_number <= most_scans) return;
    std::snprintf(reader.wrong, sizeof reader.wrong, "more than %d scans", most_scans);
    std::longjmp(reader.way_out, 1);
}

bool read_header(Reader& reader, std::string_view bytes) {
    if (setjmp(reader.way_out)) return false;
    jpeg_create_decompress(&reader.jpeg);
    reader.jpeg.client_data = &reader;
    reader.progress.progress_monitor = bound_scans;
    reader.jpeg.progress = &reader.progress;
    jpeg_mem_src(&reader.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&reader.jpeg, TRUE);
    reader.jpeg.out_color_space = JCS_RGB;
    return true;
}

bool start(Reader& reader) {
    if (setjmp(reader.way_out)) return false;
    jpeg_start_decompress(&reader.jpeg);
    return true;
}

bool read_row(Reader& reader) {
    if (setjmp(reader.way_out)) return false;
    unsigned char* row = reader.row.data();
    return jpeg_read_scanlines(&reader.jpeg, &row, 1) == 1;
}

}  // namespace

std::string decode_jpeg(std::string_view bytes, std::uint64_t most_pixels, render::Bitmap& bitmap,
                        long& damage) {
    Reader reader;
    reader.jpeg.err = jpeg_std_error(&reader.errors);
    reader.errors.error_exit = note_error;
    reader.errors.output_message = ignore_message;
    reader.jpeg.client_data = &reader;
    if (!read_header(reader, bytes)) return reader.wrong;
    const std::uint64_t width = reader.jpeg.image_width, height = reader.jpeg.image_height;
    if (width * height > most_pixels)
        return fmt::format("{} x {} pixels; at most {} are read", width, height, most_pixels);
    if (!start(reader)) return reader.wrong;
    bitmap.width = static_cast<std::uint32_t>(width);
    bitmap.height = static_cast<std::uint32_t>(height);
    bitmap.texels.reserve(width * height);
    reader.row.resize(3 * width);
    for (std::uint64_t row = 0; row < height; ++row) {
        if (!read_row(reader)) return reader.wrong;
        for (std::uint64_t i = 0; i < width; ++i)
            bitmap.texels.push_back(0xFF000000u | static_cast<std::uint32_t>(reader.row[3 * i + 2]) << 16 |
                                    static_cast<std::uint32_t>(reader.row[3 * i + 1]) << 8 |
                                    reader.row[3 * i]);
    }
    damage = reader.errors.num_warnings;
    return {};
}

#else

std::string decode_jpeg(std::string_view, std::uint64_t, render::Bitmap&, long&) {
    return "this build has no libjpeg; install libjpeg62-turbo-dev, then configure and build again";
}

#endif

}  // namespace vndf::gltf
