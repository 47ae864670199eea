// A library that has the name but not the calls.
extern "C" {
unsigned hdInitDevice(const char*) { return 0; }
void hdDisableDevice(unsigned) {}
}
