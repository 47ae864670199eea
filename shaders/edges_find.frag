// First half of the edge smoothing: keeps the pixels that differ from a neighbour. They leave their
// mark in the depth buffer, so that the costly second half runs for them alone (software drivers
// skip what a depth test rejects, but run both sides of an if).
uniform sampler2D u_picture;

float luma(vec3 c) { return dot(c, vec3(0.30, 0.59, 0.11)); }

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  float m = luma(texelFetch(u_picture, p, 0).rgb);
  float n = luma(texelFetchOffset(u_picture, p, 0, ivec2(0, 1)).rgb);
  float s = luma(texelFetchOffset(u_picture, p, 0, ivec2(0, -1)).rgb);
  float e = luma(texelFetchOffset(u_picture, p, 0, ivec2(1, 0)).rgb);
  float w = luma(texelFetchOffset(u_picture, p, 0, ivec2(-1, 0)).rgb);
  float low = min(m, min(min(n, s), min(e, w)));
  float high = max(m, max(max(n, s), max(e, w)));
  if (high - low < max(0.045, high * 0.13)) discard;
}
