#pragma once

// OpenAL, found when it is needed: Osteon runs without it, and links none of it. Its binary
// interface is fixed by the OpenAL 1.1 specification (Creative Technology, 2005): what is used of
// it is declared here.
#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// What is called of it, under its own names.
struct Libal {
  void* (*alcOpenDevice)(const char* name) = nullptr;
  char (*alcCloseDevice)(void* device) = nullptr;
  void* (*alcCreateContext)(void* device, const int* attributes) = nullptr;
  char (*alcMakeContextCurrent)(void* context) = nullptr;
  void (*alcDestroyContext)(void* context) = nullptr;
  void (*alcGetIntegerv)(void* device, int what, int size, int* values) = nullptr;
  char (*alcIsExtensionPresent)(void* device, const char* name) = nullptr;
  void (*alGenSources)(int count, unsigned* sources) = nullptr;
  void (*alDeleteSources)(int count, const unsigned* sources) = nullptr;
  void (*alGenBuffers)(int count, unsigned* buffers) = nullptr;
  void (*alDeleteBuffers)(int count, const unsigned* buffers) = nullptr;
  void (*alBufferData)(unsigned buffer, int format, const void* data, int bytes, int hz) = nullptr;
  void (*alSourceQueueBuffers)(unsigned source, int count, const unsigned* buffers) = nullptr;
  void (*alSourceUnqueueBuffers)(unsigned source, int count, unsigned* buffers) = nullptr;
  void (*alGetSourcei)(unsigned source, int what, int* value) = nullptr;
  void (*alSourcef)(unsigned source, int what, float value) = nullptr;
  void (*alSourcePlay)(unsigned source) = nullptr;
  void (*alSourceRewind)(unsigned source) = nullptr;
  int (*alGetError)() = nullptr;
};

inline constexpr int kAlGain = 0x100A, kAlSourceState = 0x1010, kAlPlaying = 0x1012,
                     kAlStopped = 0x1014, kAlBuffersProcessed = 0x1016, kAlMono16 = 0x1101,
                     kAlcConnected = 0x313;

/// The usual file of the library.
std::string libal_file();
/// Fails with the package to install where it does not load or lacks a function. It stays loaded.
Result<Libal> load_libal(const std::string& file);

}  // namespace osteon
