float fog() { return gl_FragCoord.z / gl_FragCoord.w; }
