// Depth alone: for what is drawn twice, so that each pixel is lit once.
void main() {}
