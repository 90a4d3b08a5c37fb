enum { WIDTH = 96, HEIGHT = 64, FRAMES = 4 };

/* Draws a frame, at most WIDTH x HEIGHT, and prints one line. A context is current. */
void scene(const char *who, int frame, int width, int height);
