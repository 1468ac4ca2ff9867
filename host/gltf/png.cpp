// libpng leaves its functions by longjmp: what has a destructor stays out of those that it may leave.
#include "gltf/decode.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#if CLVNDF_PNG
#include <png.h>
#endif

namespace vndf::gltf {

#if CLVNDF_PNG

namespace {

// The bytes of a texel are those of a word, red first.
static_assert(std::endian::native == std::endian::little);

struct Reader {
    std::string_view left;
    png_structp png = nullptr;
    png_infop info = nullptr;
    char wrong[128] = "";
    std::vector<png_bytep> rows;

    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
    auto& left = static_cast<Reader*>(png_get_io_ptr(png))->left;
    if (count > left.size()) png_error(png, "the file ends early");
    std::memcpy(to, left.data(), count);
    left.remove_prefix(count);
}

[[noreturn]] void note_error(png_structp png, png_const_charp message) {
    char* const wrong = static_cast<Reader*>(png_get_error_ptr(png))->wrong;
    std::strncpy(wrong, message, sizeof Reader::wrong - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

bool read_header(Reader& reader) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_read_fn(reader.png, &reader, read_bytes);
    png_set_chunk_malloc_max(reader.png, 1 << 20);
    png_set_chunk_cache_max(reader.png, 64);
    png_read_info(reader.png, reader.info);
    png_set_expand(reader.png);
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

bool read_rows(Reader& reader) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_read_image(reader.png, reader.rows.data());
    return true;
}

// deflate makes at most 1032 bytes of one.
constexpr std::uint64_t largest_growth = 1032;

}  // namespace

std::string decode_png(std::string_view bytes, std::uint64_t most_pixels, render::Bitmap& bitmap) {
    Reader reader;
    reader.left = bytes;
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, note_error, ignore_warning);
    if (reader.png) reader.info = png_create_info_struct(reader.png);
    if (!reader.info) return "libpng cannot start";
    if (!read_header(reader)) return reader.wrong;
    const std::uint64_t width = png_get_image_width(reader.png, reader.info),
                        height = png_get_image_height(reader.png, reader.info);
    if (width * height > most_pixels)
        return fmt::format("{} x {} pixels; at most {} are read", width, height, most_pixels);
    if (width * height / 8 > largest_growth * bytes.size())  // a bit of each pixel
        return fmt::format("{} x {} pixels in {} bytes", width, height, bytes.size());
    if (png_get_rowbytes(reader.png, reader.info) != 4 * width) return "libpng makes other rows of it";
    bitmap.width = static_cast<std::uint32_t>(width);
    bitmap.height = static_cast<std::uint32_t>(height);
    bitmap.texels.resize(width * height);
    for (std::uint64_t row = 0; row < height; ++row)
        reader.rows.push_back(reinterpret_cast<png_bytep>(bitmap.texels.data() + row * width));
    return read_rows(reader) ? "" : reader.wrong;
}

#else

std::string decode_png(std::string_view, std::uint64_t, render::Bitmap&) {
    return "this build has no libpng; install libpng-dev, then configure and build again";
}

#endif

}  // namespace vndf::gltf
