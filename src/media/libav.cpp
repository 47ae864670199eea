#include "libav.h"

#include <dlfcn.h>

#include <array>

namespace osteon {
namespace {

std::string versioned(const char* name, int version) {
  return std::string(name) + ".so." + std::to_string(version);
}

std::string packages() {
  return "install FFmpeg's libraries: libavcodec" + std::to_string(LIBAVCODEC_VERSION_MAJOR) +
         " and libavformat" + std::to_string(LIBAVFORMAT_VERSION_MAJOR);
}

/// Looks functions up in all loaded libraries; remembers the first name that is missing.
struct Symbols {
  std::vector<void*> libraries;
  std::string missing;

  template <class Function>
  void take(const char* name, Function& function) {
    for (void* library : libraries)
      if (void* found = ::dlsym(library, name)) {
        function = reinterpret_cast<Function>(found);
        return;
      }
    if (missing.empty()) missing = name;
  }
};

void take_format(Symbols& from, Libav& av) {
  from.take("avformat_alloc_output_context2", av.avformat_alloc_output_context2);
  from.take("avformat_new_stream", av.avformat_new_stream);
  from.take("avformat_write_header", av.avformat_write_header);
  from.take("avformat_free_context", av.avformat_free_context);
  from.take("av_interleaved_write_frame", av.av_interleaved_write_frame);
  from.take("av_write_trailer", av.av_write_trailer);
  from.take("avio_alloc_context", av.avio_alloc_context);
  from.take("avio_context_free", av.avio_context_free);
}

void take_codec(Symbols& from, Libav& av) {
  from.take("avcodec_find_encoder_by_name", av.avcodec_find_encoder_by_name);
  from.take("avcodec_alloc_context3", av.avcodec_alloc_context3);
  from.take("avcodec_open2", av.avcodec_open2);
  from.take("avcodec_free_context", av.avcodec_free_context);
  from.take("avcodec_parameters_from_context", av.avcodec_parameters_from_context);
  from.take("avcodec_send_frame", av.avcodec_send_frame);
  from.take("avcodec_receive_packet", av.avcodec_receive_packet);
  from.take("av_packet_alloc", av.av_packet_alloc);
  from.take("av_packet_free", av.av_packet_free);
  from.take("av_packet_rescale_ts", av.av_packet_rescale_ts);
}

void take_util(Symbols& from, Libav& av) {
  from.take("av_frame_alloc", av.av_frame_alloc);
  from.take("av_frame_free", av.av_frame_free);
  from.take("av_frame_get_buffer", av.av_frame_get_buffer);
  from.take("av_frame_make_writable", av.av_frame_make_writable);
  from.take("av_channel_layout_default", av.av_channel_layout_default);
  from.take("av_dict_set", av.av_dict_set);
  from.take("av_dict_free", av.av_dict_free);
  from.take("av_malloc", av.av_malloc);
  from.take("av_freep", av.av_freep);
  from.take("av_strerror", av.av_strerror);
  from.take("av_log_set_level", av.av_log_set_level);
}

}  // namespace

std::vector<std::string> libav_files() {
  return {versioned("libavutil", LIBAVUTIL_VERSION_MAJOR),
          versioned("libavcodec", LIBAVCODEC_VERSION_MAJOR),
          versioned("libavformat", LIBAVFORMAT_VERSION_MAJOR)};
}

Result<Libav> load_libav(std::span<const std::string> files) {
  Symbols symbols;
  for (const std::string& file : files) {
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      const char* said = ::dlerror();
      return fail("films need a library that does not load (" +
                      std::string(said ? said : "no reason given") + ")",
                  file, packages());
    }
    symbols.libraries.push_back(library);
  }
  Libav av;
  take_format(symbols, av);
  take_codec(symbols, av);
  take_util(symbols, av);
  if (!symbols.missing.empty())
    return fail("FFmpeg's libraries have no " + symbols.missing, "films", packages());
  av.av_log_set_level(AV_LOG_QUIET);
  return av;
}

std::string libav_text(const Libav& av, int code) {
  std::array<char, 128> text{};
  av.av_strerror(code, text.data(), text.size());
  return text.data();
}

}  // namespace osteon
