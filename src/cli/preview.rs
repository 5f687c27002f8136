//! `shotsilk preview`: the window, or a script in its place.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use super::args::ShotArgs;
use super::failure::Failure;
use super::shot::set_yielding_threads;
use crate::app::replay::{self, Player, Screen};
use crate::app::{Desk, Preferences, ScriptError, cache_folder, script_from_text, window};
use crate::preview::{Previewer, Source, Start, Wake};
use crate::render::{AdapterChoice, RenderError};

#[derive(Args, Debug)]
pub struct PreviewArgs {
    #[command(flatten)]
    shot: ShotArgs,
    /// The graphics adapter: any, software, hardware, or part of a name
    #[arg(long, default_value = "any")]
    adapter: AdapterChoice,
    /// Where frames are kept between starts; without it the user's cache folder
    #[arg(long, value_name = "FOLDER")]
    cache: Option<PathBuf>,
    /// Keep no frames between starts, and no preferences
    #[arg(long, conflicts_with = "cache")]
    no_cache: bool,
    /// Do not simulate until asked
    #[arg(long)]
    halted: bool,
    /// Do what a script says, then end; docs/previewer.md lists its steps
    #[arg(long, value_name = "FILE")]
    replay_actions: Option<PathBuf>,
    /// Where a script is replayed
    #[arg(long, value_enum, default_value_t = ReplayIn::Memory, requires = "replay_actions")]
    replay_in: ReplayIn,
    /// Size in pixels of a screen in memory
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: [u32; 2],
    /// Pixels to a point of a screen in memory
    #[arg(long, default_value_t = 1.0, value_parser = parse_scale)]
    scale: f32,
}

/// `--replay-in`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ReplayIn {
    /// A picture that only screenshots show; no display is needed
    Memory,
    /// A window
    Window,
}

/// # Errors
/// If arguments or script are bad, or there is neither display nor adapter.
pub fn run(args: &PreviewArgs) -> Result<()> {
    set_yielding_threads(args.shot.threads)?;
    let source = source(args)?;
    let player = args.replay_actions.as_ref().map(player).transpose()?;
    let make_desk = |wake: Wake| desk(args, source, wake);
    let shown = match (player, args.replay_in) {
        (Some(player), ReplayIn::Memory) => {
            let screen = Screen { size: args.size, scale: args.scale };
            replay::run(&args.adapter, screen, make_desk, player)
        }
        (player, _) => window::run(&args.adapter, make_desk, player),
    };
    shown.map_err(with_exit_code)
}

fn with_exit_code(error: anyhow::Error) -> anyhow::Error {
    let error = match error.downcast::<RenderError>() {
        Ok(error) => return Failure::from(error).into(),
        Err(error) => error,
    };
    match error.downcast::<ScriptError>() {
        Ok(ScriptError::NotOpened(why)) => Failure::BadInput(why).into(),
        Ok(error) => error.into(),
        Err(error) => error,
    }
}

fn source(args: &PreviewArgs) -> Result<Source> {
    Ok(match &args.shot.shot {
        Some(path) if path.is_dir() => Source::Run(path.clone()),
        _ => Source::Shot(args.shot.request()?),
    })
}

fn player(path: &PathBuf) -> Result<Player> {
    let text = std::fs::read_to_string(path)
        .with_context(|| format!("cannot read the script {:?}", path.display()))?;
    let steps = script_from_text(&path.to_string_lossy(), &text)
        .map_err(|error| Failure::BadInput(error.to_string()))?;
    Ok(Player::new(steps))
}

fn desk(args: &PreviewArgs, source: Source, wake: Wake) -> Desk {
    let preferences = match (&args.cache, args.no_cache) {
        (_, true) => Preferences::default(),
        (Some(folder), _) => Preferences::read(&folder.join("preferences.json")),
        // A script leaves the user's own as they are.
        (None, false) if args.replay_actions.is_some() => Preferences::default(),
        (None, false) => Preferences::of_user(),
    };
    let cache = match (&args.cache, args.no_cache) {
        (_, true) => None,
        (Some(folder), _) => Some(folder.join("frames")),
        (None, false) => cache_folder(),
    };
    let previewer = Previewer::start(Start {
        source,
        look: preferences.look,
        cache,
        memory: preferences.memory_mb << 20,
        simulating: !args.halted,
        wake: wake.clone(),
    });
    Desk::new(previewer, preferences, args.adapter.clone(), wake)
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let number = |part: &str| part.parse().ok().filter(|n| (64..=8192).contains(n));
    text.split_once('x')
        .and_then(|(width, height)| Some([number(width)?, number(height)?]))
        .ok_or_else(|| format!("{text:?} is not WIDTHxHEIGHT, each 64 to 8192 pixels"))
}

fn parse_scale(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|scale| (0.5..=4.0).contains(scale));
    number.ok_or_else(|| format!("{text:?} is not a number from 0.5 to 4"))
}
