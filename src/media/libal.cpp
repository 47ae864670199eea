#include "libal.h"

#include <dlfcn.h>

namespace osteon {
namespace {

template <class Function>
bool find_al(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  return function != nullptr;
}

bool find_all(void* l, Libal& al) {
  return find_al(l, "alcOpenDevice", al.alcOpenDevice) &&
         find_al(l, "alcCloseDevice", al.alcCloseDevice) &&
         find_al(l, "alcCreateContext", al.alcCreateContext) &&
         find_al(l, "alcMakeContextCurrent", al.alcMakeContextCurrent) &&
         find_al(l, "alcDestroyContext", al.alcDestroyContext) &&
         find_al(l, "alcGetIntegerv", al.alcGetIntegerv) &&
         find_al(l, "alcIsExtensionPresent", al.alcIsExtensionPresent) &&
         find_al(l, "alGenSources", al.alGenSources) &&
         find_al(l, "alDeleteSources", al.alDeleteSources) &&
         find_al(l, "alGenBuffers", al.alGenBuffers) &&
         find_al(l, "alDeleteBuffers", al.alDeleteBuffers) &&
         find_al(l, "alBufferData", al.alBufferData) &&
         find_al(l, "alSourceQueueBuffers", al.alSourceQueueBuffers) &&
         find_al(l, "alSourceUnqueueBuffers", al.alSourceUnqueueBuffers) &&
         find_al(l, "alGetSourcei", al.alGetSourcei) && find_al(l, "alSourcef", al.alSourcef) &&
         find_al(l, "alSourcePlay", al.alSourcePlay) &&
         find_al(l, "alSourceRewind", al.alSourceRewind) && find_al(l, "alGetError", al.alGetError);
}

// OpenAL tries every way to a loudspeaker, and ALSA's library writes on the terminal, in ten lines,
// why one of them fails. The window says in words when there is no sound.
void tell_nothing(const char*, int, const char*, int, const char*, ...) {}
void silence_alsa() {
  using Tell = void (*)(const char* file, int line, const char* function, int error,
                        const char* format, ...);
  void* alsa = ::dlopen("libasound.so.2", RTLD_NOW | RTLD_LOCAL);
  int (*set_tell)(Tell) = nullptr;
  if (alsa && find_al(alsa, "snd_lib_error_set_handler", set_tell)) set_tell(&tell_nothing);
}

}  // namespace

std::string libal_file() { return "libopenal.so.1"; }

Result<Libal> load_libal(const std::string& file) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
    return fail("OpenAL was not found", file, "Install the package libopenal1 to hear anything");
  Libal al;
  if (!find_all(library, al))
    return fail("this is not OpenAL 1.1", file, "Install the package libopenal1 to hear anything");
  silence_alsa();
  return al;
}

}  // namespace osteon
