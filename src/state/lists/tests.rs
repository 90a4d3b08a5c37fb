//! Which commands form one run, and which names lists have.

use super::*;

/// The runs of a list of commands, with how many commands each has.
fn runs(commands: &[Command]) -> Vec<(Run, usize)> {
    let mut list = Compiling::new(ListName(1), c::COMPILE, ListName(100));
    let mut counts = vec![0];
    for &command in commands {
        if list.needs_split(command).is_some() {
            list.split(ListName(100 + counts.len() as u32));
            counts.push(0);
        }
        list.note(command, Touch::NONE);
        if let Some(last) = counts.last_mut() {
            *last += 1;
        }
    }
    list.finish();
    list.body().iter().map(|s| s.run).zip(counts).collect()
}

const ANY: Command = Command::Of(Run::Open);
const DRAW: Command = Command::Of(Run::Draw);
const STATE: Command = Command::Of(Run::State);
const RASTER: Command = Command::Of(Run::Raster);

#[test]
fn what_can_be_put_back_stays_with_the_drawing() {
    use Command::*;
    let robot = [
        PushAttrib(1),
        PushMatrix,
        Matrix,
        ANY,
        DRAW,
        PopMatrix,
        DRAW,
        PopAttrib,
    ];
    assert_eq!(runs(&robot), [(Run::Draw, 8)]);
    assert_eq!(runs(&[ANY, Matrix]), [(Run::Open, 2)]);
    assert_eq!(runs(&[]), [(Run::Open, 0)]);
}

#[test]
fn the_projection_is_set_once() {
    use Command::*;
    let list = [
        MatrixMode(c::PROJECTION),
        PushMatrix,
        Matrix,
        MatrixMode(c::MODELVIEW),
        Matrix,
        DRAW,
        MatrixMode(c::PROJECTION),
        PopMatrix,
    ];
    assert_eq!(
        runs(&list),
        [(Run::State, 5), (Run::Draw, 1), (Run::State, 2)]
    );
}

#[test]
fn a_stack_is_popped_once_where_the_list_did_not_push() {
    use Command::*;
    assert_eq!(runs(&[DRAW, PopMatrix]), [(Run::Draw, 1), (Run::State, 1)]);
    assert_eq!(runs(&[PopAttrib, DRAW]), [(Run::State, 1), (Run::Draw, 1)]);
    let across = [PushAttrib(1), STATE, DRAW, PopAttrib];
    assert_eq!(
        runs(&across),
        [(Run::State, 2), (Run::Draw, 1), (Run::State, 1)]
    );
}

#[test]
fn clears_pictures_and_calls_stand_alone() {
    let clear = Command::Of(Run::Clear);
    assert_eq!(
        runs(&[ANY, clear, clear, ANY, DRAW]),
        [(Run::Open, 1), (Run::Clear, 2), (Run::Draw, 2)]
    );
    assert_eq!(runs(&[RASTER, RASTER]), [(Run::Raster, 2)]);
    let run = Run::List(ListName(7));
    assert_eq!(
        runs(&[Command::Of(run), Command::Of(run)]),
        [(run, 1), (run, 1)]
    );
}

#[test]
fn nothing_is_split_inside_a_primitive() {
    let mut list = Compiling::new(ListName(1), c::COMPILE, ListName(9));
    list.note(DRAW, Touch::NONE);
    list.between = true;
    assert_eq!(list.needs_split(Command::Of(Run::List(ListName(3)))), None);
    list.note(Command::Of(Run::List(ListName(3))), Touch::ALL);
    list.finish();
    assert_eq!(list.body()[0].run, Run::Draw);
}

#[test]
fn what_is_left_open_is_known() {
    use Command::*;
    const VERTEX: Command = Immediate(Effect::VERTEX);
    let body = |commands: &[Command]| {
        let mut list = Compiling::new(ListName(1), c::COMPILE, ListName(9));
        for &command in commands {
            if list.needs_split(command).is_some() {
                list.split(ListName(10));
            }
            list.note(command, Touch::NONE);
        }
        list.finish();
        let (first, last) = (&list.body()[0], &list.body()[list.body().len() - 1]);
        (first.closes, first.pops, last.opens, last.pushes.clone())
    };
    assert_eq!(body(&[Begin(4), VERTEX, End]), (false, 0, None, vec![]));
    assert_eq!(body(&[ANY, Begin(7), VERTEX]), (false, 0, Some(7), vec![]));
    assert_eq!(body(&[VERTEX, End, ANY]), (true, 0, None, vec![]));
    // This is an error wherever the list is called.
    assert_eq!(body(&[ANY, End]), (false, 0, None, vec![]));
    assert_eq!(
        body(&[PopAttrib, PopAttrib, PushAttrib(5)]),
        (false, 2, None, vec![5])
    );
}

#[test]
fn names_come_from_the_top_and_are_used_again() {
    let mut lists = Lists::default();
    let mut taken = vec![ListName(0xBFFF_FFFF)];
    let a = lists.name(|n| taken.contains(&n));
    taken.push(a);
    assert_eq!(a, ListName(0xBFFF_FFFE));
    assert!(lists.define(ListName(5), [fresh(a)].into()).is_empty());
    assert_eq!(lists.delete(ListName(0), u32::MAX), [a]);
    assert!(lists.body(ListName(5)).is_none());
    // Nobody gets the name before the driver has deleted its list.
    assert_ne!(lists.name(|_| false), a);
    lists.spare(a);
    assert_eq!(lists.name(|_| false), a);
}

/// Another thread may be calling a list while this one compiles it again or deletes it.
#[test]
fn runs_are_kept_while_they_are_called() {
    let mut lists = Lists::default();
    let body = |name| -> Body { [fresh(ListName(name))].into() };
    lists.define(ListName(5), body(100));
    let called = lists.body(ListName(5));
    assert_eq!(lists.define(ListName(5), body(101)), []);
    assert_eq!(lists.delete(ListName(5), 1), [ListName(101)]);
    drop(called);
    assert_eq!(lists.define(ListName(6), body(102)), [ListName(100)]);
}

/// Two threads have got names from the driver before either is told of them.
#[test]
fn names_are_claimed_once() {
    let mut lists = Lists::default();
    let one = lists.claim(ListName(3), 2);
    let other = lists.claim(ListName(1), 2);
    assert_eq!([one, other], [ListName(1), ListName(3)]);
    assert_eq!(lists.unclaimed(ListName(3), 3), [ListName(5)]);
}

/// Unlike between glBegin and glEnd, arrays may be switched on and off between the elements of a list.
#[test]
fn elements_of_a_list_may_set_different_values() {
    let mut list = Compiling::new(ListName(1), c::COMPILE, ListName(100));
    let element = Command::Immediate(Effect::ELEMENT);
    for command in [Command::Begin(c::TRIANGLES), element, Command::End] {
        list.note(command, Touch::NONE);
    }
    list.finish();
    let body = list.body();
    let segment = body.iter().next().expect("a run");
    assert!(segment.immediate.must_restore().has(Effect::UNKNOWN));
}
