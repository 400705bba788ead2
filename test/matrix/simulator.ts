/** The simulated PLC of the installed package, started as a user would start it: `melsec-jw simulate`. */
import { spawn } from 'node:child_process'
import { once } from 'node:events'
import { join } from 'node:path'

export interface RunningSimulator {
  /** On 127.0.0.1, chosen by the system. */
  readonly port: number
  stop(): Promise<void>
}

const START = 15_000

/**
 * @param options what follows `melsec-jw simulate --port 0`, e.g. `['--profile', 'iq-f']`
 */
export async function startSimulator(
  node: string,
  userDir: string,
  options: readonly string[],
): Promise<RunningSimulator> {
  const script = join(userDir, 'node_modules', '@melsec-jw', 'plc', 'dist', 'src', 'cli', 'main.js')
  const child = spawn(node, [script, 'simulate', '--port', '0', ...options], {
    cwd: userDir,
    stdio: ['ignore', 'pipe', 'pipe'],
  })
  const gone = once(child, 'exit')
  const stop = async (): Promise<void> => {
    child.kill('SIGTERM')
    const overdue = setTimeout(() => child.kill('SIGKILL'), 5000)
    await gone
    clearTimeout(overdue)
  }
  try {
    return { port: await announcedPort(child, gone), stop }
  } catch (error) {
    await stop()
    throw error
  }
}

/** The simulator says where it listens: a line with `127.0.0.1:<port>`. */
async function announcedPort(child: ReturnType<typeof spawn>, gone: Promise<unknown>): Promise<number> {
  let output = ''
  let timer: NodeJS.Timeout | undefined
  const port = new Promise<number>((resolve) => {
    const look = (chunk: Buffer): void => {
      output += chunk.toString()
      const found = /127\.0\.0\.1:(\d+)/.exec(output)
      if (found) resolve(Number(found[1]))
    }
    child.stdout?.on('data', look)
    child.stderr?.on('data', look)
  })
  const late = new Promise<undefined>((resolve) => {
    timer = setTimeout(() => resolve(undefined), START)
  })
  const result = await Promise.race([port, late, gone.then(() => undefined)])
  clearTimeout(timer)
  if (result === undefined) throw new Error(`melsec-jw simulate did not say where it listens:\n${output}`)
  return result
}
