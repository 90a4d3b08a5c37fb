# Every target works on a fresh clone; `make help` lists them.

PREFIX ?= /usr/local
# Which mutants `make mutants` tries: every tenth, from number 6 on.
MUTANTS ?= 6/10
# Seconds for each target of `make fuzz`.
FUZZ_SECONDS ?= 600
CARGO ?= cargo
TARGET := $(abspath $(or $(CARGO_TARGET_DIR),target))
BIN := $(TARGET)/release
# The oldest C library that what `make release` builds runs on (Debian 10, RHEL 8), and where it is put.
GLIBC := 2.28
RELEASE := $(TARGET)/release-$(GLIBC)
DEMOS := $(TARGET)/demos
# The same of 32 bits.
RUST_32 := i686-unknown-linux-gnu
DEMOS_32 := $(TARGET)/demos-32
PICTURES := $(TARGET)/demo
# The outputs that `make demo` shows of each program; only the panel's picture needs the panel.
OUTPUTS := panel quilt sbs
# The picture of the README: the views as a quilt, and under it the panel that holds them all.
README_SCENE := --frame 40 --eye-spacing 0.3 --focal-depth 8

# Debian packages that building, the demos and the tests need; then optional packages of some tests.
PACKAGES := gcc libc6-dev make xvfb libgl1 libegl1 libgl1-mesa-dri libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0 libwayland-client0 libosmesa6 libosmesa6-dev libgl-dev libegl-dev \
	libx11-dev libpng-dev mesa-utils apitrace khronos-api
OPTIONAL_PACKAGES := faketime glslang-tools tesseract-ocr weston sway grim wtype mesa-utils-bin
# Programs that test-long and test-full record and repeat.
LONG_PACKAGES := gltron xscreensaver-gl piglit
# What 32-bit programs, and building them, need. The architecture i386 is added to dpkg.
PACKAGES_32 := gcc-multilib g++-multilib libgl1:i386 libegl1:i386 libgl1-mesa-dri:i386 libosmesa6:i386 libosmesa6-dev:i386 \
	libgl-dev:i386 libegl-dev:i386 libx11-dev:i386 libpng-dev:i386 libglu1-mesa-dev:i386
# Containers, desks of Wayland, and programs for them of both classes.
PACKAGES_LAUNCH := bubblewrap debootstrap weston xwayland mesa-utils-bin mesa-utils-bin:i386
# Wine of both classes, and what compiles programs for it.
PACKAGES_WINE := wine wine64 wine32:i386 gcc-mingw-w64-x86-64 gcc-mingw-w64-i686
# Tests that preload the layer into programs of this project.
TESTS_32 := answers cases conditions drawables front harm hosts memory oracle outputs passes passthrough quad random shaded
NOT_32 := a_captured_picture_replaces_no_other_file capture_says_that_there_is_no_stereo_window
# Tests that `check-shadow` runs: those that preload the layer into programs of this project and compare what these get.
TESTS_SHADOW := answers cases conditions drawables front oracle passes quad random shaded
# Tests that `sanitize` runs: random calls, programs with threads, hosts of plugins, rare commands.
TESTS_SANITIZED := random harm hosts drawables answers
# Packages of test-full only.
FULL_PACKAGES := valgrind
# Drivers of test-drivers that are not Mesa's own software renderers: lavapipe, under zink.
DRIVER_PACKAGES := mesa-vulkan-drivers
# Demo programs that `manyview bench` draws; they are installed with it.
SCENES := mesh arrays fill room menu field hard
BENCH := $(TARGET)/bench
# Demo programs that `make same` draws, beside the traces of `make programs`.
SAME := arrays blur clip crowd field fill fogtexgen gears immediate lists menu mesh mirror passes points prims relief room shade sky teapot
# Packages that only the pictures of the documents need.
PICTURE_PACKAGES := netpbm
# A game with a timedemo (423 MB), only for the targets that play it.
OPENARENA_PACKAGES := openarena unzip
# Programs and data with shaders (140 MB), which are unpacked and not installed.
SHADER_PACKAGES := colobot-common glmark2-data goxel ioquake3 kodi-data libopenscenegraph161 libqt5gui5 libsdl2-2.0-0 meshlab \
	mgba-common minetest-data openmw-data openscad openscenegraph pymol-data python3-vispy qtbase5-examples solvespace \
	trackballs-data xmoto xscreensaver-gl xscreensaver-gl-extra

# What makes the packages of `make deb`.
DEB_PACKAGES := dpkg-dev binutils
# The name of packaging/manyview.metainfo.xml, which is that in the file.
APPSTREAM_ID := io.github.manyview.manyview
VERSION := $(shell sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)

.PHONY: help build library-32 release demos demo bench overhead overhead-ways panel-cost points-cost points-large pictures gallery test test-long check-shadow test-32 test-both test-launch test-wine test-full test-drivers build-32 demos-32 packages-32 programs looks looks-strategies soak calibration openarena openarena-walk openarena-pictures same measured mutants sanitize fuzz shaders man notices book lint packages \
	install install-debug uninstall deb dist clean

help: ## list the targets
	@sed -n 's/^\([a-z0-9-]*\):.*## /\1	/p' $(MAKEFILE_LIST) | expand -t 20

# The unit tests of the hooks need the driver that records calls. This does not touch libmanyview.so, which `build` alone makes.
FAKE_DRIVER := --features manyview-shim/fake-driver

# The viewer is built and tested by itself: together with the others it would give their crates the features, and the code, of its own.
CRATES := --workspace --exclude manyview-viewer
VIEWER := -p manyview-viewer

# Three calls on purpose: one would give the library the features, and the code, of the command.
build: rust ## build the command, the library, the probe and the viewer of point clouds
	$(CARGO) build --release -p manyview
	$(CARGO) build --release -p manyview-shim
	$(CARGO) build --release $(VIEWER)
	@if sh scripts/has-32.sh $(RUST_32); then $(MAKE) library-32; fi

# Both are linked under the names by which the loader finds that of a program's class.
library-32: rust
	$(CARGO) build --release --target $(RUST_32) -p manyview-shim
	@sh scripts/by-class.sh $(BIN) ../../../$(RUST_32)/release/libmanyview.so

release: rust ## build what runs on systems with glibc 2.28 and later (needs cargo-zigbuild and zig); target/release-2.28
	@sh scripts/release.sh $(GLIBC) $(RELEASE)
	MANYVIEW_RELEASE=$(RELEASE) $(CARGO) test --release --test all -- release:: --include-ignored

demos: packages ## build the demo programs
	$(MAKE) -C examples OUT=$(DEMOS)

demo: packages build demos ## show glxgears and a demo in 8 views; writes PNGs
	@mkdir -p $(PICTURES)
	@set -e; for output in $(OUTPUTS); do \
		for app in glxgears $(DEMOS)/teapot; do \
			env -u DISPLAY $(BIN)/manyview capture --frame 30 --output $$output \
				--out $(PICTURES)/$$(basename $$app)-$$output.png -- $$app >/dev/null; \
		done; \
	done
	@echo "The pictures are in $(PICTURES)"

bench: packages build demos ## measure the layer on four scenes (two minutes); writes JSON, CSV and a chart
	@mkdir -p $(BENCH)
	$(BIN)/manyview bench --json $(BENCH)/bench.json --csv $(BENCH)/bench.csv --chart $(BENCH)/bench.png

pictures: packages build demos ## make the picture of the README
	@sh scripts/packages.sh $(PICTURE_PACKAGES)
	@mkdir -p $(PICTURES) docs
	env -u DISPLAY $(BIN)/manyview capture $(README_SCENE) --output quilt --out $(PICTURES)/views_qs4x2.png -- \
		$(DEMOS)/mirror --size 168x126
	env -u DISPLAY $(BIN)/manyview capture $(README_SCENE) --output panel --out $(PICTURES)/panel.png -- \
		$(DEMOS)/mirror --size 672x336
	pngtopnm $(PICTURES)/views_qs4x2.png >$(PICTURES)/quilt.ppm
	pngtopnm $(PICTURES)/panel.png | pnmcat -topbottom $(PICTURES)/quilt.ppm - | pnmtopng -compression 9 >docs/mirror.png

gallery: packages build demos ## make the pictures of docs/gallery.md
	@sh scripts/packages.sh $(PICTURE_PACKAGES)
	$(CARGO) test --release --test all -- gallery_photos --ignored
	$(CARGO) test --release --test all -- gallery_wall --ignored
	@sh scripts/gallery.sh $(BIN) $(DEMOS)/mirror docs/gallery $(TARGET)/gallery

test: packages build demos ## run the tests
	@if $(CARGO) nextest --version >/dev/null 2>&1; \
	then $(CARGO) nextest run --release --no-fail-fast --no-tests=warn $(CRATES) $(FAKE_DRIVER); \
	else $(CARGO) test --release --no-fail-fast $(CRATES) $(FAKE_DRIVER) --lib --bins --tests; fi
	$(CARGO) test --release $(VIEWER) --lib --bins --tests
	$(CARGO) test --release -p manyview --doc

test-long: packages build demos ## run the tests that take long as well
	@sh scripts/packages.sh --optional $(LONG_PACKAGES)
	@if $(CARGO) nextest --version >/dev/null 2>&1; \
	then MANYVIEW_TESTS_ALL=1 $(CARGO) nextest run --release --no-fail-fast --no-tests=warn $(CRATES) $(FAKE_DRIVER) --run-ignored all -E 'not (binary(all) & test(/^[a-z_]+::(drivers|full|looks|programs|release|soak|both|wine)_/))'; \
	else MANYVIEW_TESTS_ALL=1 $(CARGO) test --release --no-fail-fast $(CRATES) $(FAKE_DRIVER) --lib --bins --tests -- --include-ignored --skip drivers_are_as_good --skip full_ --skip looks_ --skip programs_ --skip release_ --skip soak_ --skip both_ --skip wine_; fi
	$(CARGO) test --release $(VIEWER) --lib --bins --tests -- --include-ignored
	$(CARGO) test --release -p manyview --doc

packages-32: packages ## install the i386 packages that are missing
	@sh scripts/packages.sh $(PACKAGES_32)
	rustup target add $(RUST_32)

build-32: packages-32 build ## build the library for 32-bit programs as well (installs i386 packages)

demos-32: packages-32 ## build the demo programs of 32 bits
	$(MAKE) -C examples OUT=$(DEMOS_32) CC="gcc -m32"

test-32: build-32 demos-32 ## run the tests that preload the layer in programs of 32 bits (installs i386 packages)
	MANYVIEW_TESTS_BITS=32 $(CARGO) test --release --no-fail-fast --test all -- $(TESTS_32:%=%::) $(NOT_32:%=--skip %)

test-both: build-32 demos demos-32 ## run the tests of programs of both classes under one command (installs i386 packages)
	$(CARGO) test --release --no-fail-fast --test all -- both:: --ignored

test-launch: packages-32 build-32 ## start programs in containers and under Wayland (installs packages of both classes, and makes another /usr of 600 MB)
	@sh scripts/packages.sh $(PACKAGES_LAUNCH)
	@sh scripts/other-usr.sh $(TARGET)/launch/trixie
	$(CARGO) test --release --no-fail-fast --test all -- launch_ways:: --ignored --test-threads 1 --nocapture

test-wine: build-32 ## run programs for Windows under Wine (installs it, and i386 packages)
	@sh scripts/packages.sh $(PACKAGES_WINE)
	$(MAKE) -C examples/windows OUT=$(TARGET)/windows
	$(CARGO) test --release --no-fail-fast --test all -- windows:: --ignored --test-threads 1

test-full: packages build demos ## run all tests but those of programs, also all of piglit's, valgrind and fuzz (three hours)
	@sh scripts/packages.sh --optional $(LONG_PACKAGES) $(FULL_PACKAGES)
	@sh scripts/shaders.sh $(TARGET)/shaders/packages $(SHADER_PACKAGES)
	@if $(CARGO) nextest --version >/dev/null 2>&1; \
	then MANYVIEW_TESTS_ALL=1 $(CARGO) nextest run --release --no-fail-fast --no-tests=warn $(CRATES) $(FAKE_DRIVER) --run-ignored all -E 'not (binary(all) & test(/^[a-z_]+::(drivers|looks|programs|release|soak|both|wine)_/))'; \
	else MANYVIEW_TESTS_ALL=1 $(CARGO) test --release --no-fail-fast $(CRATES) $(FAKE_DRIVER) --lib --bins --tests -- --include-ignored --skip drivers_are_as_good --skip looks_ --skip programs_ --skip release_ --skip soak_ --skip both_ --skip wine_; fi
	$(CARGO) test --release $(VIEWER) --lib --bins --tests -- --include-ignored
	$(CARGO) test --release -p manyview --doc
	@if $(CARGO) deny fetch >/dev/null 2>&1; then $(CARGO) deny --workspace check advisories; else echo "advisories of crates are not checked: cargo-deny or its database is not to be had here" >&2; fi
	$(MAKE) check-shadow
	@if rustc +nightly --version >/dev/null 2>&1; then $(MAKE) sanitize; else echo "no sanitizer watches the library: run rustup toolchain install nightly to have that" >&2; fi
	@if $(CARGO) fuzz --version >/dev/null 2>&1; then $(MAKE) fuzz; else echo "nothing is fuzzed: run cargo install cargo-fuzz to have that" >&2; fi
	@if sh scripts/packages.sh $(PACKAGES_32); then $(MAKE) test-32 test-both test-wine test-launch; else echo "32-bit programs are not tested: i386 is not to be had here" >&2; fi

random: packages build ## make ten thousand sequences of random calls with and without the layer (an hour)
	$(CARGO) test --release --no-fail-fast --test all -- random::full_ten --ignored --nocapture

random-32: packages build-32 ## the same in programs of 32 bits (installs i386 packages)
	MANYVIEW_TESTS_BITS=32 $(CARGO) test --release --no-fail-fast --test all -- random::full_ten --ignored --nocapture

check-shadow: packages build demos ## run tests with a library that compares the state it keeps with the driver's
	$(CARGO) build --release --target-dir $(TARGET)/check-shadow -p manyview-shim --features check-shadow
	MANYVIEW_TESTS_LIBRARY=$(TARGET)/check-shadow/release/libmanyview.so $(CARGO) test --release --no-fail-fast --test all -- $(TESTS_SHADOW:%=%::) --skip full_

test-drivers: packages build demos ## run the main tests on old versions and other drivers; writes docs/drivers.md (half an hour)
	@sh scripts/packages.sh --optional $(DRIVER_PACKAGES)
	$(CARGO) test --release --test all -- drivers::drivers_ --ignored --nocapture

programs: packages build ## run real programs with and without the layer; writes docs/compatibility.md (two hours)
	$(CARGO) test --release --test all -- programs::programs_ --ignored --nocapture --test-threads=1

looks: packages build ## play games as a new user launches them, without an option; writes docs/looks.md with pictures (an hour)
	$(CARGO) test --release --test all -- looks::looks_of_games --ignored --nocapture

looks-strategies: packages build ## play them under each strategy, the only option; writes docs/looks-strategies.md (two hours)
	$(CARGO) test --release --test all -- looks::looks_are_right --ignored --nocapture

calibration: ## fit photos of simulated displays and compare with the truth; writes docs/calibrated.md (two hours)
	$(CARGO) test --release --test all -- calibrate_glass::full_ calibrate_rough::full_ --ignored --nocapture --test-threads 1

soak: packages build ## play a game's demo for SOAK_MINUTES (240) and watch memory and GL names; target/soak
	$(CARGO) test --release --test all -- soak::soak_ --ignored --nocapture

openarena: packages build ## play OpenArena's timedemo with and without the layer; prints the frame rates (423 MB, half an hour)
	@sh scripts/packages.sh $(OPENARENA_PACKAGES)
	@sh scripts/openarena.sh $(BIN) $(TARGET)/openarena

openarena-walk: packages build ## hold OpenArena in 8 views at a rate by `hybrid`, plotted, and show it by every strategy (half an hour)
	@sh scripts/packages.sh $(OPENARENA_PACKAGES) $(PICTURE_PACKAGES) apitrace
	@sh scripts/openarena.sh $(BIN) $(TARGET)/openarena walk
	cp $(TARGET)/openarena/walk.png docs/openarena-walk.png
	cp $(TARGET)/openarena/strategies.png docs/openarena-strategies.png

openarena-pictures: packages build ## make the pictures of OpenArena in the README
	@sh scripts/packages.sh $(OPENARENA_PACKAGES) $(PICTURE_PACKAGES)
	@sh scripts/openarena.sh $(BIN) $(TARGET)/openarena pictures
	cp $(TARGET)/openarena/quilt.png docs/openarena-views.png
	cp $(TARGET)/openarena/panel.png docs/openarena-panel.png

same: packages build demos ## are pictures what they were? compares with the build in OTHER, such as ../before/target/release; target/same
	@test -n "$(OTHER)" || { echo "OTHER is missing: give the folder of another build, such as OTHER=../before/target/release" >&2; exit 1; }
	@sh scripts/same.sh $(OTHER) $(BIN) $(TARGET)/same $(addprefix $(DEMOS)/,$(SAME)) $(wildcard $(TARGET)/programs/*/program.trace)

measured: packages build demos ## take the tables of docs/measured.md again (a quarter of an hour, nothing else running); target/measured
	@sh scripts/measured.sh $(BIN) $(TARGET)/measured

mutants: rust ## do the unit tests see changes of the path of a draw? MUTANTS=6/10 (needs cargo-mutants; an hour)
	@sh scripts/mutants.sh $(MUTANTS) $(TARGET)/mutants

sanitize: packages build demos ## run tests with a library that sanitizers of addresses and of threads watch (needs nightly); target/sanitize
	@sh scripts/sanitize.sh address $(TARGET)/sanitize/address $(TESTS_SANITIZED)
	@sh scripts/sanitize.sh thread $(TARGET)/sanitize/thread $(TESTS_SANITIZED)

fuzz: rust ## feed random files, requests and shaders to what reads them, each kind for FUZZ_SECONDS=600 (needs cargo-fuzz); target/fuzz
	@sh scripts/fuzz.sh $(FUZZ_SECONDS) $(TARGET)/fuzz

shaders: packages build ## rewrite real shaders, of programs and of piglit, and compile them before and after (140 MB, ten minutes)
	@sh scripts/shaders.sh $(TARGET)/shaders/packages $(SHADER_PACKAGES)
	$(CARGO) test --release --test all -- shaders::full_ --ignored --nocapture

panel-cost: build demos ## what the panel's window and the on-screen display cost
	@sh scripts/panel-cost.sh $(BIN) $(DEMOS)

points-cost: build ## the time of splats drawn once for all views, beside one view and a pass for each (five minutes)
	@EGL_PLATFORM=surfaceless $(BIN)/manyview-probe points-cost

points-large: build ## show a point cloud of a hundred million points (three minutes, a file of 560 MB)
	$(CARGO) test --release --test all -- viewer::full_ --ignored --nocapture

overhead: packages build demos ## measure the layer where it does nothing: switched off, and with one view (ten minutes)
	@sh scripts/overhead.sh $(BIN) $(TARGET)/overhead $(DEMOS)

overhead-ways: packages-32 build-32 demos ## the same under Wine and in a container (ten minutes; installs packages)
	@sh scripts/packages.sh $(PACKAGES_WINE) $(PACKAGES_LAUNCH)
	@sh scripts/other-usr.sh $(TARGET)/launch/trixie
	$(MAKE) -C examples/windows OUT=$(TARGET)/windows
	$(CARGO) test --release --test all -- overhead_ways:: --ignored --nocapture

man: build ## write the manual pages to target/man
	$(BIN)/manyview man --out $(TARGET)/man

notices: rust ## write THIRD-PARTY-NOTICES.txt from the sources of the crates
	BLESS=1 $(CARGO) test --release --test all notices::every_crate

book: ## build the manual as HTML in target/book (needs mdbook)
	@command -v mdbook >/dev/null 2>&1 || \
		{ echo "mdbook is missing: run cargo install mdbook, then make book again" >&2; exit 1; }
	mdbook build --dest-dir $(TARGET)/book

# By the profile of `make build`, so that both share what is compiled for build scripts and macros.
lint: rust ## check format, clippy, documentation, and the crates where cargo-deny is there
	$(CARGO) fmt --all --check
	$(CARGO) fmt --manifest-path fuzz/Cargo.toml --check
	$(CARGO) clippy --release $(CRATES) --all-targets $(FAKE_DRIVER) -- -D warnings
	$(CARGO) clippy --release $(VIEWER) --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --release --no-deps -p manyview
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --release --no-deps $(VIEWER) --lib
	@if $(CARGO) deny --version >/dev/null 2>&1; then $(CARGO) deny --workspace check licenses bans sources; \
	else echo "licences and versions of crates are not checked: run cargo install cargo-deny to have that" >&2; fi

packages: ## install the Debian packages that are missing
	@sh scripts/packages.sh $(PACKAGES) --optional $(OPTIONAL_PACKAGES)

.PHONY: rust
rust:
	@command -v $(CARGO) >/dev/null 2>&1 || \
		{ echo "Rust is missing: get it from https://rustup.rs, then run make again" >&2; exit 1; }

# Installing does not build, so that `sudo make install` leaves no files of root in target/.
install: ## install to PREFIX after `make build` (default /usr/local)
	@test -x $(BIN)/manyview && test -f $(BIN)/libmanyview.so && test -x $(BIN)/manyview-probe && test -x $(BIN)/manyview-points || \
		{ echo "Nothing to install: run make build first" >&2; exit 1; }
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/lib/manyview \
		$(DESTDIR)$(PREFIX)/lib/manyview/profiles $(DESTDIR)$(PREFIX)/share/manyview/shaders $(DESTDIR)$(PREFIX)/share/doc/manyview
	install -s -m 755 $(BIN)/manyview $(DESTDIR)$(PREFIX)/bin/manyview
	install -s -m 644 $(BIN)/libmanyview.so $(DESTDIR)$(PREFIX)/lib/manyview/libmanyview.so
	install -s -m 755 $(BIN)/manyview-probe $(DESTDIR)$(PREFIX)/lib/manyview/manyview-probe
	install -s -m 755 $(BIN)/manyview-points $(DESTDIR)$(PREFIX)/lib/manyview/manyview-points
	rm -rf $(DESTDIR)$(PREFIX)/lib/manyview/by-class
	@if test -f $(BIN)/by-class/32/libmanyview.so; then \
		install -d $(DESTDIR)$(PREFIX)/lib/manyview/32 && \
		install -s -m 644 $(BIN)/by-class/32/libmanyview.so $(DESTDIR)$(PREFIX)/lib/manyview/32/libmanyview.so && \
		install -s -m 755 $(TARGET)/$(RUST_32)/release/manyview-probe $(DESTDIR)$(PREFIX)/lib/manyview/32/manyview-probe && \
		sh scripts/by-class.sh $(DESTDIR)$(PREFIX)/lib/manyview ../../32/libmanyview.so; \
	else echo "The library for 32-bit programs is not built: run make build-32 first to install it as well" >&2; fi
	@for scene in $(SCENES); do test -x $(DEMOS)/$$scene || \
		{ echo "The scenes of manyview bench are not built: run make demos first to install them as well" >&2; exit 0; }; done; \
		install -d $(DESTDIR)$(PREFIX)/lib/manyview/scenes && \
		install -m 755 $(addprefix $(DEMOS)/,$(SCENES)) $(DESTDIR)$(PREFIX)/lib/manyview/scenes/
	for profile in $(wildcard profiles/*.toml); do \
		install -m 644 $$profile $(DESTDIR)$(PREFIX)/lib/manyview/profiles/ || exit 1; done
	for shader in $(wildcard shaders/*.wgsl); do \
		install -m 644 $$shader $(DESTDIR)$(PREFIX)/share/manyview/shaders/ || exit 1; done
	install -d $(DESTDIR)$(PREFIX)/share/man/man1
	$(BIN)/manyview man --out $(DESTDIR)$(PREFIX)/share/man/man1
	chmod 644 $(DESTDIR)$(PREFIX)/share/man/man1/manyview*.1
	@completions=$$(mktemp -d) && trap 'rm -rf "$$completions"' EXIT && \
		$(BIN)/manyview completions --out "$$completions" && \
		install -D -m 644 "$$completions/manyview.bash" $(DESTDIR)$(PREFIX)/share/bash-completion/completions/manyview && \
		install -D -m 644 "$$completions/_manyview" $(DESTDIR)$(PREFIX)/share/zsh/site-functions/_manyview && \
		install -D -m 644 "$$completions/manyview.fish" $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d/manyview.fish
	install -D -m 644 packaging/manyview.metainfo.xml $(DESTDIR)$(PREFIX)/share/metainfo/$(APPSTREAM_ID).metainfo.xml
	install -m 644 README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md LICENSE THIRD-PARTY-NOTICES.txt $(DESTDIR)$(PREFIX)/share/doc/manyview/
	find docs -type f \( -name '*.md' -o -name '*.png' \) -exec install -D -m 644 {} $(DESTDIR)$(PREFIX)/share/doc/manyview/{} \;

# Debuggers look for .debug/NAME.debug beside a binary that has a debug link, which holds the file's checksum.
install-debug: install ## install the debug information of what install has stripped, beside it
	@set -e; for binary in bin/manyview lib/manyview/libmanyview.so lib/manyview/manyview-probe lib/manyview/manyview-points; do \
		folder=$(DESTDIR)$(PREFIX)/$$(dirname $$binary); name=$$(basename $$binary); \
		install -d $$folder/.debug; \
		objcopy --only-keep-debug $(BIN)/$$name $$folder/.debug/$$name.debug; \
		objcopy --remove-section=.gnu_debuglink --add-gnu-debuglink=$$folder/.debug/$$name.debug $$folder/$$name; \
	done

uninstall: ## remove what install has put to PREFIX
	rm -f $(DESTDIR)$(PREFIX)/bin/manyview $(DESTDIR)$(PREFIX)/bin/.debug/manyview.debug
	rm -f $(DESTDIR)$(PREFIX)/share/man/man1/manyview.1 $(DESTDIR)$(PREFIX)/share/man/man1/manyview-*.1
	rm -f $(DESTDIR)$(PREFIX)/share/bash-completion/completions/manyview $(DESTDIR)$(PREFIX)/share/zsh/site-functions/_manyview \
		$(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d/manyview.fish $(DESTDIR)$(PREFIX)/share/metainfo/$(APPSTREAM_ID).metainfo.xml
	rm -rf $(DESTDIR)$(PREFIX)/lib/manyview $(DESTDIR)$(PREFIX)/share/manyview $(DESTDIR)$(PREFIX)/share/doc/manyview

# Of the build for older systems: make release, then make deb BIN=target/release-2.28. DEBFULLNAME and DEBEMAIL name the maintainer.
deb: build demos ## make Debian packages of what install puts to /usr; target/deb (the one of i386 after make build-32)
	@sh scripts/packages.sh $(DEB_PACKAGES)
	@sh packaging/debian/build.sh $(TARGET)/deb

# The source that packaging/arch/PKGBUILD and packaging/flatpak name, from what is committed.
dist: ## write the source as target/manyview-VERSION.tar.gz
	@mkdir -p $(TARGET)
	git archive --prefix=manyview-$(VERSION)/ --output=$(TARGET)/manyview-$(VERSION).tar.gz HEAD
	@echo "$(TARGET)/manyview-$(VERSION).tar.gz"

clean: ## remove what was built
	$(CARGO) clean
