#!/bin/sh
# Takes the tables of docs/measured.md again. Usage: measured.sh BIN OUT [NAME…]; the names are those of the functions below, all of them unless given.
# Nothing else may run meanwhile. What is printed is in OUT/NAME.txt.
set -eu
bin=$1 out=$2
shift 2
mkdir -p "$out"

bench() {
	env -u DISPLAY "$bin/manyview" bench "$@"
}

strategies() {
	bench --scene mesh-100k,mesh-800k,draws-3000,mesh-100k-immediate,mesh-100k-list,room \
		--strategy auto,replay,instanced,instanced-distances,geometry --frames 7
}

view_scale() {
	for scale in 1 auto 0.61; do
		bench --scene fill,fill-textured --strategy replay --view-scale $scale --size 1920x1080 --frames 7
	done
	bench --scene fill,fill-textured --strategy replay --view-scale auto --display lenticular-8 --size 1920x1080 --frames 7
}

depth_images() {
	bench --scene mesh-100k,mesh-800k --strategy replay,instanced,depth-image --views 8,48 --display slanted8 --size 1280x720 --frames 7
	bench --scene mesh-4m,room --strategy replay,depth-image --display slanted8 --size 1280x720 --frames 5
}

occlusion() {
	for _ in 1 2 3; do
		bench --scene mesh-800k --strategy depth-image,occlusion,hybrid-2,hybrid-3 --views 8,48 --display slanted8 --size 1280x720
	done
}

optimisations() {
	bench --scene menu,field,mesh-100k-immediate,draws-3000 --strategy replay --disable mono,lists,frustum --frames 7
	bench --scene draws-3000,mesh-100k --strategy replay --display rows --disable unseen --frames 7
	bench --scene draws-3000 --strategy instanced --disable uniforms --frames 7
}

many_views() {
	bench --scene mesh-100k,draws-3000,fill --strategy replay --views 8,16,32 --frames 5
	bench --scene mesh-100k --strategy replay,instanced --views 2,4,8,17 --frames 3
	bench --scene mesh-4m --strategy replay --frames 3
}

papers() {
	bench --preset luo-table1
	bench --preset luo-table2 --frames 3
	bench --preset desorbier-fig7 --frames 3
	bench --preset desorbier-fig8 --frames 3
	bench --preset desorbier-fig9 --frames 5
}

interleave() {
	env -u DISPLAY "$bin/manyview-probe" interleave
}

[ $# -gt 0 ] || set -- strategies view_scale depth_images occlusion optimisations many_views papers interleave
for name in "$@"; do
	echo "$name" >&2
	"$name" >"$out/$name.txt" 2>"$out/$name.log" || { cat "$out/$name.log" >&2; exit 1; }
done
